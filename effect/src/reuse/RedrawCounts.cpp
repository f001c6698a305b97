#include "reuse/RedrawCounts.h"

#include <algorithm>
#include <utility>

namespace tyndall {

const gl::Query& RedrawCounts::unusedQuery() {
  const auto isUsed = [this](const gl::Query* query) {
    const auto holds = [query](const std::vector<const gl::Query*>& some) {
      return std::find(some.begin(), some.end(), query) != some.end();
    };
    return holds(planned_) ||
           std::any_of(frames_.begin(), frames_.end(), [&](const Frame& frame) { return holds(frame.count.queries); });
  };
  auto unused = std::find_if(queries_.begin(), queries_.end(), [&](const gl::Query& query) { return !isUsed(&query); });
  if (unused == queries_.end()) {
    queries_.emplace_back(gl_);
    unused = queries_.end() - 1;
  }
  planned_.push_back(&*unused);
  return *unused;
}

void RedrawCounts::add(RedrawCount count) {
  planned_.clear();
  if (frames_.size() == kMostFrames) frames_.pop_front();
  frames_.push_back({std::move(count), false});
}

std::vector<double> RedrawCounts::takeCounted() {
  std::vector<double> shares;
  for (Frame& frame : frames_) {
    if (frame.taken) continue;
    if (!read(frame.count, false)) break;
    frame.taken = true;
    if (frame.count.mayReuse) shares.push_back(shareOf(frame.count));
  }
  while (frames_.size() > 1 && frames_.front().taken)
    frames_.pop_front();
  return shares;
}

double RedrawCounts::lastShare() {
  if (frames_.empty()) return 1;
  RedrawCount& count = frames_.back().count;
  read(count, true);
  return shareOf(count);
}

bool RedrawCounts::read(RedrawCount& count, bool waits) {
  while (!count.queries.empty()) {
    gl::Uint64 available = 1, changed = 0;
    if (!waits) gl_.GetQueryObjectui64v(count.queries.back()->name(), gl::QUERY_RESULT_AVAILABLE, &available);
    if (!available) return false;
    gl_.GetQueryObjectui64v(count.queries.back()->name(), gl::QUERY_RESULT, &changed);
    count.changed += changed;
    count.queries.pop_back();
  }
  return true;
}

double RedrawCounts::shareOf(const RedrawCount& count) {
  return count.segments > 0 ? static_cast<double>(count.changed) / static_cast<double>(count.segments) : 1;
}

// ---------------------------------------------------------------------------------------------------------------------

void Rests::judge(double redrawnShare, double fullShare) {
  constexpr int kLongest = 16;
  const bool busy = redrawnShare > fullShare;
  if (busy && (busy_ || pause_ > 1)) {
    rest_ = pause_;
    pause_ = std::min(2 * pause_, kLongest);
  }
  if (!busy) pause_ = 1;
  busy_ = busy;
}

bool Rests::takeOne() {
  if (rest_ == 0) return false;
  --rest_;
  return true;
}

} // namespace tyndall
