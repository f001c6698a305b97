#include "PassRecorder.h"

namespace tyndall {

void PassRecorder::beginFrame() {
  passes_.clear();
  fixupPixels_ = 0;
  marched_ = 0;
  visitsPerRay_ = 0;
  counts_.clear();
}

void PassRecorder::skip(const std::string& pass, const std::string& why) {
  passes_.push_back({{pass, why, 0}, {}, {}});
}

void PassRecorder::begin(const std::string& name) {
  passes_.push_back({{name, {}, 0}, {}, {}});
  if (gl_.version >= 43 && gl_.PushDebugGroup)
    gl_.PushDebugGroup(gl::DEBUG_SOURCE_THIRD_PARTY, 0, -1, ("Tyndall: " + name).c_str());
  if (timing_ == PassTiming::Finish) {
    gl_.Finish();
    start_ = std::chrono::steady_clock::now();
  } else if (timing_ == PassTiming::TimerQuery) {
    passes_.back().from = gl::Query(gl_);
    passes_.back().to = gl::Query(gl_);
    gl_.QueryCounter(passes_.back().from.name(), gl::TIMESTAMP);
  }
}

void PassRecorder::end() {
  if (timing_ == PassTiming::Finish) {
    gl_.Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start_;
    passes_.back().statistics.milliseconds = time.count();
  } else if (timing_ == PassTiming::TimerQuery) {
    gl_.QueryCounter(passes_.back().to.name(), gl::TIMESTAMP);
  }
  if (gl_.version >= 43 && gl_.PopDebugGroup) gl_.PopDebugGroup();
}

void PassRecorder::beginCount() {
  gl::Int busy = 0;
  gl_.GetQueryiv(gl::SAMPLES_PASSED, gl::CURRENT_QUERY, &busy);
  counting_ = busy == 0;
  if (!counting_) return;
  counts_.emplace_back(gl_);
  gl_.BeginQuery(gl::SAMPLES_PASSED, counts_.back().name());
}

void PassRecorder::endCount() {
  if (counting_) gl_.EndQuery(gl::SAMPLES_PASSED);
}

// What the newest query counted.
std::uint64_t PassRecorder::takeCount() {
  if (!counting_) return 0;
  gl::Uint64 count = 0;
  gl_.GetQueryObjectui64v(counts_.back().name(), gl::QUERY_RESULT, &count);
  counts_.pop_back();
  return count;
}

std::uint64_t PassRecorder::marched() {
  counting_ = true;
  while (!counts_.empty())
    marched_ += takeCount();
  return marched_;
}

std::vector<PassStatistics> PassRecorder::collect() {
  std::vector<PassStatistics> result;
  for (Timed& pass : passes_) {
    if (pass.from) {
      gl::Uint64 from = 0, to = 0;
      gl_.GetQueryObjectui64v(pass.from.name(), gl::QUERY_RESULT, &from);
      gl_.GetQueryObjectui64v(pass.to.name(), gl::QUERY_RESULT, &to);
      pass.statistics.milliseconds = static_cast<double>(to - from) * 1e-6;
    }
    result.push_back(pass.statistics);
  }
  return result;
}

} // namespace tyndall
