// Debug slices: what a debug view shows of one light's slices, samples and pixels (glsl/passes/debugSlices,
// debugSamples, red, pixelTree with COUNT_VISITS).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::debug_slices {

/// Adds to the view's texture. For FixupPixels the stencil is as unwarp leaves it.
void plan(LightPlanner& light, DebugView view);

} // namespace tyndall::passes::debug_slices
