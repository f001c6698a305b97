#include "CameraPath.h"

#include <algorithm>

namespace viewer {

namespace {

constexpr double kLeastSeconds = 0.05; ///< between two points

bool isSame(const settings::LookAt& a, const settings::LookAt& b) {
  return a.eye == b.eye && a.target == b.target && a.fovDegrees == b.fovDegrees;
}

} // namespace

void addPoint(std::vector<settings::PathPoint>& path, double seconds, const settings::LookAt& view) {
  const std::size_t count = path.size();
  const bool rests = count >= 2 && isSame(path[count - 1].view, view) && isSame(path[count - 2].view, view);
  if (rests) {
    path.back().seconds = seconds;
    return;
  }
  if (count >= settings::kMostPathPoints || (count > 0 && seconds - path.back().seconds < kLeastSeconds)) return;
  path.push_back({seconds, view});
}

settings::LookAt viewAt(const std::vector<settings::PathPoint>& path, double seconds) {
  const auto after =
      std::upper_bound(path.begin(), path.end(), seconds,
                       [](double time, const settings::PathPoint& point) { return time < point.seconds; });
  if (after == path.begin()) return path.front().view;
  if (after == path.end()) return path.back().view;
  const settings::PathPoint &a = *(after - 1), &b = *after;
  const double share = (seconds - a.seconds) / (b.seconds - a.seconds);
  settings::LookAt view;
  view.eye = glm::mix(a.view.eye, b.view.eye, share);
  view.target = glm::mix(a.view.target, b.view.target, share);
  view.fovDegrees = glm::mix(a.view.fovDegrees, b.view.fovDegrees, share);
  return view.eye == view.target ? a.view : view;
}

} // namespace viewer
