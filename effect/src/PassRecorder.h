// Times passes and keeps the statistics of a frame.
#pragma once

#include "gl/Objects.h"

#include <chrono>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

class PassRecorder {
public:
  PassRecorder(const gl::Functions& gl, PassTiming timing) : gl_(gl), timing_(timing) {}

  void beginFrame();
  void skip(const std::string& pass, const std::string& why);
  void countFixup(std::uint64_t pixels) { fixupPixels_ += pixels; }
  std::uint64_t fixupPixels() const { return fixupPixels_; }
  void countMarched(std::uint64_t rays) { marched_ += rays; }
  void countVisits(double perRay) { visitsPerRay_ = perRay; }
  double visitsPerRay() const { return visitsPerRay_; }
  /// Rays integrated in the frame; waits for the queries of runCounted().
  std::uint64_t marched();

  /// Runs a pass: times it and, where the context has debug groups, names it for GL debuggers.
  template <typename Pass>
  bool run(const std::string& name, Pass&& pass) {
    begin(name);
    const bool ok = pass();
    end();
    return ok;
  }

  /// Runs a pass of which every fragment that is not discarded marches one ray. Not counted while a query of the
  /// engine's own is under way.
  template <typename Pass>
  bool runCounted(const std::string& name, Pass&& pass) {
    return run(name, [&] {
      beginCount();
      const bool ok = pass();
      endCount();
      return ok;
    });
  }

  /// Draws, and returns how many fragments were written, for which it waits; 0 while a query of the engine's own is
  /// under way.
  template <typename Draw>
  std::uint64_t countWritten(Draw&& draw) {
    beginCount();
    draw();
    endCount();
    return takeCount();
  }

  /// Draws, and has a query count how many fragments were written, without waiting for it. False while a query of the
  /// engine's own is under way; draws all the same.
  template <typename Draw>
  bool countInto(const gl::Query& query, Draw&& draw) {
    gl::Int busy = 0;
    gl_.GetQueryiv(gl::SAMPLES_PASSED, gl::CURRENT_QUERY, &busy);
    if (busy == 0) gl_.BeginQuery(gl::SAMPLES_PASSED, query.name());
    draw();
    if (busy == 0) gl_.EndQuery(gl::SAMPLES_PASSED);
    return busy == 0;
  }

  /// Passes of the frame in order; waits for timer queries.
  std::vector<PassStatistics> collect();

private:
  struct Timed {
    PassStatistics statistics;
    gl::Query from, to;
  };
  void begin(const std::string& name);
  void end();
  void beginCount();
  void endCount();
  std::uint64_t takeCount();

  const gl::Functions& gl_;
  PassTiming timing_;
  std::chrono::steady_clock::time_point start_;
  std::vector<Timed> passes_;
  std::uint64_t fixupPixels_ = 0;
  std::uint64_t marched_ = 0;
  double visitsPerRay_ = 0;
  std::vector<gl::Query> counts_;
  bool counting_ = false;
};

} // namespace tyndall
