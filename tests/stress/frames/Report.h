// What many random frames come to.
#pragma once

#include "Checks.h"

#include <nlohmann/json.hpp>

namespace stress {

/// Upper ends of the classes that errors are counted in; one more class for what is above.
inline constexpr std::array<double, 6> kErrorClasses = {1e-5, 1e-4, 1e-3, 1e-2, kTolerance, 0.5};

class Report {
public:
  void add(std::uint64_t seed, const Outcome& outcome, double seconds);
  void addFinding(std::uint64_t seed, const Finding& finding, const std::string& simple);
  /// The most turns of loops, by name: LoopCounter.
  void addLoops(std::uint64_t seed, const std::map<std::string, std::uint32_t>& turns);
  void merge(const nlohmann::json& other);

  nlohmann::json json() const;
  std::string text() const; ///< for a terminal
  std::uint64_t frames() const { return frames_; }
  std::size_t findings() const { return findings_.size(); }

private:
  void addWorst(const std::string& run, double error, std::uint64_t seed);

  std::uint64_t frames_ = 0, pictures_ = 0;
  double longest_ = 0; ///< seconds of a frame
  std::uint64_t longestSeed_ = 0;
  std::map<std::string, std::array<std::uint64_t, kErrorClasses.size() + 1>> errors_; ///< by run
  std::map<std::string, std::pair<double, std::uint64_t>> worst_; ///< error by run, and of which seed
  std::map<std::string, std::uint64_t> illConditioned_;
  std::map<std::string, std::pair<std::uint32_t, std::uint64_t>> loops_; ///< most turns, and of which seed
  std::vector<nlohmann::json> findings_;
};

} // namespace stress
