// A multisampled depth: where a pixel's samples show several surfaces, light is the mean over them. Elsewhere, and
// along slices, there is one depth a pixel (glsl/passes/plainDepth.frag).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::samples {

/// As light.drawLight(); of a multisampled depth the pixels at edges once for each of their samples.
void drawLight(LightPlanner& light, Pass pass, const DrawOptions& options);

} // namespace tyndall::passes::samples
