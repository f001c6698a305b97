// Draws what has changed of slices, rows and pixels since the last frame (Frame::reuse; glsl/passes/changedEnds,
// changedParts, changedSegments, changedSlices, changedStrips, changedTiles, tiles, changedPixels).
#pragma once

#include "plan/LightPlanner.h"
#include "reuse/RedrawPlan.h"

namespace tyndall::reuse {

/// What redrawing needs of the frame.
struct Redrawing {
  KeptEye& eye;
  bool counts;       ///< queries may be used
  RedrawCount count; ///< of the lights so far
};

/// The light's slices up to the light of all samples: kept, compared and drawn where they differ, or all of them. What
/// turns out not to be kept becomes Redraw::All.
void planSlices(LightPlanner& light, LightRedraw& redraw, Redrawing& frame);

/// What the next frame needs of it.
KeptSlices keptOf(const LightPlanner& light, const LightRedraw& redraw);

/// Flags of the tiles, or bits of the stencil's pixels (Tuning::reuse), that the changed segments of the light touch,
/// and, compared by one of the lights, the depth. `begins`: there are none yet.
void planMask(LightPlanner& light, bool comparesDepth, bool begins);

} // namespace tyndall::reuse
