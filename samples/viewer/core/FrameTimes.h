// The times of the last frames.
#pragma once

#include <algorithm>
#include <vector>

namespace viewer {

class FrameTimes {
public:
  void add(double milliseconds, bool hasCompiled) {
    if (times_.size() == kMost) {
      times_.erase(times_.begin());
      compiled_.erase(compiled_.begin());
    }
    times_.push_back(static_cast<float>(milliseconds));
    compiled_.push_back(hasCompiled);
  }
  const std::vector<float>& times() const { return times_; }     ///< oldest first
  bool hasCompiled(std::size_t i) const { return compiled_[i]; } ///< a driver compiled programs meanwhile
  void clear() {
    times_.clear();
    compiled_.clear();
  }

  /// The time that this share of them does not exceed; 0 without any.
  float quantile(double share) const {
    if (times_.empty()) return 0;
    std::vector<float> sorted = times_;
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    return *place;
  }

  static constexpr std::size_t kMost = 240;

private:
  std::vector<float> times_;
  std::vector<bool> compiled_;
};

} // namespace viewer
