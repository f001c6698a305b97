#include "PassRecorder.h"

#include "SharedBlocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// What glsl/passes/sliceEstimate.frag has so many fragments for.
double estimateOf(std::uint64_t fragments) {
  return std::exp2((static_cast<double>(fragments) - ESTIMATE_LEAST) / ESTIMATE_OCTAVE);
}

} // namespace

void PassRecorder::beginFrame() {
  passes_.clear();
  counted_.clear();
  counts_ = {};
  ++frame_;
  pools().counts.used = pools().times.used = 0;
  canCount_ = gl_.countsSamples && !countsItself(gl_);
}

void PassRecorder::skip(const std::string& pass, const std::string& why) { passes_.push_back({{pass, why, 0}}); }

gl::Uint PassRecorder::nextQuery(Pool& pool) {
  if (pool.used == pool.queries.size()) pool.queries.emplace_back(gl_);
  return pool.queries[pool.used++].name();
}

void PassRecorder::begin(const std::string& name, const Counting& counting) {
  passes_.push_back({{name, {}, 0, 1}});
  if (gl_.debugOutput) gl_.PushDebugGroup(gl::DEBUG_SOURCE_THIRD_PARTY, 0, -1, ("Tyndall: " + name).c_str());
  if (timing_ == PassTiming::Finish) {
    gl_.Finish();
    start_ = std::chrono::steady_clock::now();
  } else if (timing_ == PassTiming::TimerQuery) {
    stamp();
  }
  if (!canCount_ || counting.what == Count::None) return;
  const gl::Uint query = counting.what == Count::Into ? counting.query->name() : nextQuery(pools().counts);
  if (counting.what != Count::Into) counted_.push_back({counting, query});
  gl_.BeginQuery(gl::SAMPLES_PASSED, query);
}

void PassRecorder::end(const Counting& counting) {
  if (canCount_ && counting.what != Count::None) gl_.EndQuery(gl::SAMPLES_PASSED);
  endBand();
  if (gl_.debugOutput) gl_.PopDebugGroup();
}

void PassRecorder::nextBand() {
  endBand();
  ++passes_.back().statistics.bands;
}

void PassRecorder::resume() {
  if (timing_ == PassTiming::Finish) start_ = std::chrono::steady_clock::now();
}

void PassRecorder::endBand() {
  if (timing_ == PassTiming::TimerQuery) stamp();
  if (timing_ != PassTiming::Finish) return;
  gl_.Finish();
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double, std::milli> time = now - std::exchange(start_, now);
  passes_.back().add(time.count());
}

void PassRecorder::stamp() {
  passes_.back().stamps.push_back(nextQuery(pools().times));
  gl_.QueryCounter(passes_.back().stamps.back(), gl::TIMESTAMP);
}

void PassRecorder::Timed::add(double band) {
  statistics.milliseconds += band;
  statistics.longestBand = std::max(statistics.longestBand, band);
}

std::uint64_t PassRecorder::resultOf(gl::Uint query) const {
  gl::Uint64 result = 0;
  gl_.GetQueryObjectui64v(query, gl::QUERY_RESULT, &result);
  return result;
}

const PassRecorder::Counts& PassRecorder::counts() {
  for (const Counted& counted : counted_)
    add(counted.counting, resultOf(counted.query));
  counted_.clear();
  return counts_;
}

void PassRecorder::add(const Counting& counting, std::uint64_t written) {
  const auto fixedUp = [this](std::uint64_t pixels) {
    counts_.marched += pixels;
    counts_.fixupPixels += pixels;
  };
  switch (counting.what) {
  case Count::Marched:
    counts_.marched += written * std::max<std::uint64_t>(counting.pixels, 1);
    break;
  case Count::Served:
    fixedUp(counting.pixels - std::min(written, counting.pixels));
    break;
  case Count::FixedUp:
    fixedUp(written);
    break;
  case Count::Slices:
    counts_.slices += written;
    break;
  case Count::Estimate:
    if (written > 0) counts_.errorEstimate = std::max(counts_.errorEstimate, estimateOf(written));
    break;
  case Count::OverTarget:
    counts_.shareOverTarget = std::max(counts_.shareOverTarget, static_cast<double>(written) / ESTIMATE_CODES);
    break;
  default:
    break;
  }
}

std::vector<PassStatistics> PassRecorder::collect() {
  std::vector<PassStatistics> result;
  for (Timed& pass : passes_) {
    for (std::size_t i = 1; i < pass.stamps.size(); ++i)
      pass.add(static_cast<double>(resultOf(pass.stamps[i]) - resultOf(pass.stamps[i - 1])) * 1e-6);
    pass.stamps.clear();
    result.push_back(pass.statistics);
  }
  return result;
}

} // namespace tyndall
