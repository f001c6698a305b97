// glsl/shared.glsl as C++ sees it.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace tyndall::blocks {

using glm::ivec2;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

#define UNIFORM_BLOCK(name) struct name
#include "shared.glsl"
#undef UNIFORM_BLOCK

// std140 adds no padding of its own: sizes are those of the rows, and what must begin a row does.
static_assert(sizeof(FrameBlock) == 16 * (3 + 1 + 1 + 1 + 2 * MAX_CONSTITUENTS + 6 + 2 * MAX_HEIGHT_LAYERS + 7));
static_assert(sizeof(AmbientBlock) == 16 * (AMBIENT_ROWS + 1));
static_assert(AMBIENT_ROWS == AMBIENT_TERMS * (2 + MAX_HEIGHT_LAYERS));
static_assert(sizeof(MapView) == 16 * 9);
static_assert(sizeof(LightBlock) == 16 * 7 + sizeof(MapView) * MAX_SHADOW_VIEWS);
static_assert(sizeof(CopyBlock) == 16 * (3 + 1 + 3));
static_assert(sizeof(EpipolarBlock) == 16 * 13);
constexpr bool beginsRow(std::size_t offset) { return offset % 16 == 0; }
constexpr bool isAligned(std::size_t offset) { return offset % 8 == 0; } // a pair
static_assert(beginsRow(offsetof(FrameBlock, extinction)) && beginsRow(offsetof(FrameBlock, phaseWeight)));
static_assert(beginsRow(offsetof(FrameBlock, phaseShape)) && isAligned(offsetof(FrameBlock, frameSize)));
static_assert(beginsRow(offsetof(FrameBlock, depthFirst)) && beginsRow(offsetof(FrameBlock, depthAxis)));
static_assert(isAligned(offsetof(FrameBlock, jitter)) && beginsRow(offsetof(FrameBlock, layerUp)));
static_assert(beginsRow(offsetof(FrameBlock, layerExtinction)) && isAligned(offsetof(FrameBlock, lookupSize)));
static_assert(beginsRow(offsetof(FrameBlock, eyeCurveDepth)) && beginsRow(offsetof(FrameBlock, fogScattering)));
static_assert(beginsRow(offsetof(FrameBlock, mediumScatters)));
static_assert(beginsRow(offsetof(MapView, margin)) && beginsRow(offsetof(MapView, curveDepth)));
static_assert(beginsRow(offsetof(LightBlock, lightDirection)) && beginsRow(offsetof(LightBlock, lightPosition)));
static_assert(beginsRow(offsetof(MapView, origin)) && beginsRow(offsetof(LightBlock, boundary)));
static_assert(beginsRow(offsetof(LightBlock, shadowViews)) && beginsRow(offsetof(EpipolarBlock, border)));
static_assert(beginsRow(offsetof(EpipolarBlock, storedScale)) && beginsRow(offsetof(CopyBlock, copiedDepth)));
static_assert(beginsRow(offsetof(CopyBlock, copiedOrigin)));

} // namespace tyndall::blocks
