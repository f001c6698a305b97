// The times of the last frames.
#pragma once

#include <algorithm>
#include <vector>

namespace viewer {

class FrameTimes {
public:
  void add(double milliseconds) {
    if (times_.size() == kMost) times_.erase(times_.begin());
    times_.push_back(static_cast<float>(milliseconds));
  }
  const std::vector<float>& times() const { return times_; } ///< oldest first
  void clear() { times_.clear(); }

  /// The time that this share of them does not exceed; 0 without any.
  float quantile(double share) const {
    if (times_.empty()) return 0;
    std::vector<float> sorted = times_;
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return *place;
  }

private:
  static constexpr std::size_t kMost = 240;
  std::vector<float> times_;
};

} // namespace viewer
