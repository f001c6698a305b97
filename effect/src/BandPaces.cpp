#include "BandPaces.h"

#include "Rounding.h"

#include <algorithm>

namespace tyndall {

void BandPaces::beginFrame() {
  for (Frame& frame : frames_)
    if (isKnown(frame)) learnFrom(frame);
  frame_ = (frame_ + 1) % frames_.size();
  frames_[frame_].used = 0; // not known in time
}

// The last of its results comes last.
bool BandPaces::isKnown(const Frame& frame) const {
  if (frame.used == 0) return false;
  const Watch& last = frame.watches[frame.used - 1];
  gl::Uint64 available = 0;
  gl_.GetQueryObjectui64v(last.queries[last.stamps - 1].name(), gl::QUERY_RESULT_AVAILABLE, &available);
  return available != 0;
}

void BandPaces::learnFrom(Frame& frame) {
  std::map<std::string, double> measured;
  for (std::size_t i = 0; i < frame.used; ++i) {
    double& pace = measured[frame.watches[i].title];
    pace = std::max(pace, slowest(frame.watches[i]));
  }
  frame.used = 0;
  // Longer at once, shorter bit by bit: one that is too long does harm, one that is too short does not.
  constexpr double kFalls = 0.8;
  for (const auto& [title, pace] : measured)
    if (pace > 0) paces_[title] = std::clamp(std::max(pace, kFalls * of(title)), kLeast, kMost);
}

double BandPaces::of(const std::string& title) const {
  const auto found = paces_.find(title);
  return found == paces_.end() ? 1 : found->second;
}

void BandPaces::begin(const std::string& title, double milliseconds, int bands) {
  Frame& frame = frames_[frame_];
  if (frame.used == frame.watches.size()) {
    frame.watches.emplace_back();
    for (gl::Query& query : frame.watches.back().queries)
      query = gl::Query(gl_);
  }
  current_ = &frame.watches[frame.used++];
  current_->title = title;
  current_->left = bands;
  current_->each = unitsFor(bands, kIntervals);
  current_->milliseconds = milliseconds * current_->each;
  current_->stamps = 0;
  stamp();
}

void BandPaces::endBand() {
  --current_->left;
  if (current_->left % current_->each == 0) stamp();
}

void BandPaces::stamp() { gl_.QueryCounter(current_->queries[current_->stamps++].name(), gl::TIMESTAMP); }

// Of a draw's intervals; 0 if that is not known yet, or if the clock stands.
double BandPaces::slowest(const Watch& watch) const {
  double most = 0;
  gl::Uint64 last = 0;
  for (std::size_t i = 0; i < watch.stamps; ++i) {
    gl::Uint64 available = 0, time = 0;
    gl_.GetQueryObjectui64v(watch.queries[i].name(), gl::QUERY_RESULT_AVAILABLE, &available);
    if (!available) return 0;
    gl_.GetQueryObjectui64v(watch.queries[i].name(), gl::QUERY_RESULT, &time);
    if (i > 0 && time <= last) return 0;
    if (i > 0) most = std::max(most, 1e-6 * static_cast<double>(time - last) / watch.milliseconds);
    last = time;
  }
  return most;
}

} // namespace tyndall
