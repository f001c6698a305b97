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

  /// Runs a pass: times it and, where the context has debug groups, names it for GL debuggers.
  template <typename Pass>
  bool run(const std::string& name, Pass&& pass) {
    begin(name);
    const bool ok = pass();
    end();
    return ok;
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

  const gl::Functions& gl_;
  PassTiming timing_;
  std::chrono::steady_clock::time_point start_;
  std::vector<Timed> passes_;
  std::uint64_t fixupPixels_ = 0;
};

} // namespace tyndall
