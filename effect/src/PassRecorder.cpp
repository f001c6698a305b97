#include "PassRecorder.h"

#include <algorithm>

namespace tyndall {

namespace {

// Some drivers have one place for all kinds of queries of samples.
bool countsItself(const gl::Functions& gl) {
  constexpr std::array<gl::Enum, 3> kKinds = {gl::SAMPLES_PASSED, gl::ANY_SAMPLES_PASSED,
                                              gl::ANY_SAMPLES_PASSED_CONSERVATIVE};
  const auto known = kKinds.end() - (gl.version < 43 ? 1 : 0);
  return std::any_of(kKinds.begin(), known, [&](gl::Enum kind) {
    gl::Int query = 0;
    gl.GetQueryiv(kind, gl::CURRENT_QUERY, &query);
    return query != 0;
  });
}

} // namespace

void PassRecorder::beginFrame() {
  passes_.clear();
  counted_.clear();
  fixupPixels_ = 0;
  marched_ = 0;
  ++frame_;
  pools().counts.used = pools().times.used = 0;
  counts_ = !countsItself(gl_);
}

void PassRecorder::skip(const std::string& pass, const std::string& why) { passes_.push_back({{pass, why, 0}}); }

gl::Uint PassRecorder::nextQuery(Pool& pool) {
  if (pool.used == pool.queries.size()) pool.queries.emplace_back(gl_);
  return pool.queries[pool.used++].name();
}

void PassRecorder::begin(const std::string& name, const Counting& counting) {
  passes_.push_back({{name, {}, 0}});
  if (gl_.debugOutput) gl_.PushDebugGroup(gl::DEBUG_SOURCE_THIRD_PARTY, 0, -1, ("Tyndall: " + name).c_str());
  if (timing_ == PassTiming::Finish) {
    gl_.Finish();
    start_ = std::chrono::steady_clock::now();
  } else if (timing_ == PassTiming::TimerQuery) {
    passes_.back().from = nextQuery(pools().times);
    passes_.back().to = nextQuery(pools().times);
    gl_.QueryCounter(passes_.back().from, gl::TIMESTAMP);
  }
  if (!counts_ || counting.what == Count::None) return;
  const gl::Uint query = counting.what == Count::Into ? counting.query->name() : nextQuery(pools().counts);
  if (counting.what != Count::Into) counted_.push_back({counting, query});
  gl_.BeginQuery(gl::SAMPLES_PASSED, query);
}

void PassRecorder::end(const Counting& counting) {
  if (counts_ && counting.what != Count::None) gl_.EndQuery(gl::SAMPLES_PASSED);
  if (timing_ == PassTiming::Finish) {
    gl_.Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start_;
    passes_.back().statistics.milliseconds = time.count();
  } else if (timing_ == PassTiming::TimerQuery) {
    gl_.QueryCounter(passes_.back().to, gl::TIMESTAMP);
  }
  if (gl_.debugOutput) gl_.PopDebugGroup();
}

std::uint64_t PassRecorder::resultOf(gl::Uint query) const {
  gl::Uint64 result = 0;
  gl_.GetQueryObjectui64v(query, gl::QUERY_RESULT, &result);
  return result;
}

void PassRecorder::collectCounts() {
  for (const Counted& counted : counted_) {
    const std::uint64_t written = resultOf(counted.query), pixels = counted.counting.pixels;
    const bool serves = counted.counting.what == Count::Served;
    const std::uint64_t rays = serves ? pixels - std::min(written, pixels) : written;
    marched_ += rays;
    if (counted.counting.what != Count::Marched) fixupPixels_ += rays;
  }
  counted_.clear();
}

std::uint64_t PassRecorder::fixupPixels() {
  collectCounts();
  return fixupPixels_;
}

std::uint64_t PassRecorder::marched() {
  collectCounts();
  return marched_;
}

std::vector<PassStatistics> PassRecorder::collect() {
  std::vector<PassStatistics> result;
  for (Timed& pass : passes_) {
    if (pass.from != 0) {
      const std::uint64_t from = resultOf(std::exchange(pass.from, 0)), to = resultOf(pass.to);
      pass.statistics.milliseconds = static_cast<double>(to - from) * 1e-6;
    }
    result.push_back(pass.statistics);
  }
  return result;
}

} // namespace tyndall
