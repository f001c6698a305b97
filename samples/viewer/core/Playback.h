// The time of a scene's animation.
#pragma once

#include <scene/Scene.h>

namespace viewer {

/// Seconds until the animation has played; 0 for a scene that stands still, infinite where smoke rises.
double durationOf(const host::Scene& scene);

struct Playback {
  bool isPlaying = false;
  bool loops = true;
  double speed = 1;

  /// The time after so many seconds; stops at the end unless it loops.
  double advanced(double seconds, double passed, double duration);
  /// One frame on or back, of 24 a second.
  static double stepped(double seconds, int frames, double duration);
};

} // namespace viewer
