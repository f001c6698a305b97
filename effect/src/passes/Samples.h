// A multisampled depth: where a pixel's samples show several surfaces, light is the mean over them. Elsewhere, and
// along slices, there is one depth a pixel (glsl/passes/plainDepth.frag).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::samples {

/// Draws a pass of the light over what the stencil lets through, once for each of a pixel's samples, as their mean.
void planMean(LightPlanner& light, Pass pass, const DrawOptions& options);

/// Marks those pixels as served, in a stencil that has none so far.
void planEdges(LightPlanner& light);

} // namespace tyndall::passes::samples
