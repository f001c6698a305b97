// Shadow maps that are copied before they are read: cubes, and depths that are distances (glsl/passes/mapCopy.frag).
#pragma once

#include "SharedBlocks.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::optics {

/// The views that the faces of ShadowMap::cube are, each in its layer of the cube map's array.
std::vector<ShadowView> cubeViews(const Light& light);

/// How a view of so many texels is copied. `rounding`: of stored depths, as a part of them.
blocks::CopyBlock copyBlock(const Light& light, int view, const Rectangle& texels, double rounding);

} // namespace tyndall::optics
