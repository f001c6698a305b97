// A multisampled depth: where a pixel's samples show several surfaces, light is the mean over them. Elsewhere, and
// along slices, there is one depth a pixel (glsl/passes/plainDepth.frag).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::samples {

/// As light.drawLight(); of a multisampled depth the pixels at edges once for each of their samples.
void drawLight(LightPlanner& light, Pass pass, const DrawOptions& options);

/// Of the pixels at edges what slices serve, into a texture of its own; those that have all of it are marked.
void unwarpEdges(LightPlanner& light);

/// As light.drawLight(), of a fix-up; at edges the samples that are left, into that texture.
void fixUp(LightPlanner& light, Pass pass, const DrawOptions& options);

/// Brings that texture to where the others' light is.
void addEdges(LightPlanner& light);

} // namespace tyndall::passes::samples
