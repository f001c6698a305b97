// The epipolar pipeline of one light: the list of its passes (Chen 2011, Yusov 2013).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::epipolar {

/// Adds the light by any technique but Technique::Exact, and what a debug view shows of it. Its slices are made.
void plan(LightPlanner& light, DebugView view);

/// The middle of it, for temporal reuse: from sample ends, and rows if they stand in one texture, to the light of all
/// samples.
void planToInterpolate(LightPlanner& light);

} // namespace tyndall::passes::epipolar
