// The error against Technique::Exact of a picture that is shown, in steps.
#pragma once

#include "Way.h"

#include <cstdint>
#include <vector>

namespace viewer {

/// Of the inscatter: all pixels and channels pooled, over the mean of Exact.
struct Errors {
  double rRmse = 0; ///< root of the mean squared error
  double p99 = 0;   ///< 99th percentile of the absolute error, to 0.1 %
  double mean = 0;  ///< of Exact, not divided
};

/// Adds up errors value by value, in bounded memory.
class ErrorSum {
public:
  ErrorSum() : counts_(kBins) {}
  void add(const float* got, const float* exact, std::size_t count);
  Errors errors() const;

private:
  static constexpr std::size_t kBins = 1U << 20; ///< of the upper bits of a float

  std::vector<std::uint32_t> counts_; ///< of absolute errors
  double squares_ = 0, sum_ = 0;
  std::uint64_t values_ = 0, nonFinite_ = 0;
};

class ErrorMeter {
public:
  explicit ErrorMeter(const tyndall::Config& config) : config_(config) {}

  /// Of a picture whose frame and textures stay as they are until the end. The exact one has the same shadow filter.
  void begin(const host::RenderTargets& surfaces, const std::vector<const Way*>& shown);
  void stop();
  bool isRunning() const { return exact_ && isBegun_ && !exact_->isWhole(); }
  bool isComplete() const { return exact_ && isBegun_ && exact_->isWhole(); }
  double share() const { return isBegun_ ? exact_->share() : 0; }
  void step(double milliseconds);

  /// Of each picture, so far.
  const std::vector<Errors>& errors() const { return errors_; }
  GLuint exactInscatter() const { return exact_ ? exact_->inscatter() : 0; }

private:
  void read(GLuint texture, const tyndall::Rectangle& part, std::vector<float>& values) const;

  tyndall::Config config_;
  std::unique_ptr<Way> exact_; ///< made when first needed
  host::GlFramebuffer framebuffer_;
  std::vector<GLuint> shown_; ///< inscatter
  std::vector<ErrorSum> sums_;
  std::vector<Errors> errors_;
  bool isBegun_ = false;
};

} // namespace viewer
