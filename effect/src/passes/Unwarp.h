// Unwarp: from slices to pixels, then the fix-up of those that no sample serves, or that an edge of a shadow between
// two slices crosses (Yusov 2013, "Transformation from epipolar to rectangular coordinates"; glsl/passes/unwarp,
// fixup).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::unwarp {

/// Of what interpolation left; leaves 0 in the stencil of the pixels that were fixed up, 1 in the others'.
void plan(LightPlanner& light);

} // namespace tyndall::passes::unwarp
