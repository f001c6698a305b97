// Slice choice: which slices of a light are drawn where not all need to be (Settings::errorTarget).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::slice_choice {

/// True if a light's slices are chosen, or those of a frame that is compiled ahead may be.
bool isMade(const LightPlanner& light);

/// From all slices to those that are drawn: then the slice table has them, and LightPlanner::drawnSlices says where it
/// ends. Leaves the picture's mean light, too.
void plan(LightPlanner& light);

/// True if of pixels that no sample serves some take the light of the samples around, by their share of what there
/// would be without shadows (glsl/lib/shares.glsl).
bool tellsShares(const LightPlanner& light);

} // namespace tyndall::passes::slice_choice
