// No draw too long: how long a draw may take on a slow GPU, and the bands that keep it within a limit
// (Tuning::bandMilliseconds).
#pragma once

#include "plan/FramePlan.h"
#include "plan/Passes.h"

namespace tyndall {

/// What the rays of a draw may look at.
struct RayPaths {
  int views = 0, drawnViews = 0; ///< shadow views of the light, and those that a draw walks rows of
  Size map;                      ///< texels of each
  int rowTexels = 0;             ///< of a slice's row through it
  bool tree = true;              ///< rows are walked by their trees
  int depthSamples = 1;          ///< of a pixel
};

/// What a fragment of a pass takes at most on a slow GPU, but for maps so hostile that trees are of no use.
double nanosecondsPerFragment(const PassRow& row, const LightVariant& light, const RayPaths& paths);

/// Bands of a target, none of which takes longer than that many milliseconds, if more than a pixel; 0: one for all.
Bands bandsOf(const Size& target, double nanosecondsPerFragment, double milliseconds);

} // namespace tyndall
