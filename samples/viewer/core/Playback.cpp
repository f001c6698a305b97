#include "Playback.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewer {

namespace {

constexpr double kFramesPerSecond = 24;
constexpr double kMostSeconds = 1e6; ///< that a state may have

} // namespace

double durationOf(const host::Scene& scene) {
  if (!scene.smoke.empty()) return std::numeric_limits<double>::infinity();
  double duration = 0;
  for (const host::AnimationChannel& channel : scene.animation)
    if (!channel.times.empty()) duration = std::max<double>(duration, channel.times.back());
  return duration;
}

double Playback::advanced(double seconds, double passed, double duration) {
  const double end = std::min(duration, kMostSeconds);
  const double now = seconds + speed * passed;
  if (now <= end) return now;
  if (loops && end > 0) return std::fmod(now, end);
  isPlaying = false;
  return end;
}

double Playback::stepped(double seconds, int frames, double duration) {
  const double end = std::min(duration, kMostSeconds);
  const double now = (std::round(seconds * kFramesPerSecond) + frames) / kFramesPerSecond;
  if (now < 0) return end == kMostSeconds ? 0 : end;
  return now > end ? 0 : now;
}

} // namespace viewer
