// glsl/shared.glsl as C++ sees it.
#pragma once

#include <glm/glm.hpp>

namespace tyndall::blocks {

using glm::ivec4;
using glm::mat4;
using glm::vec4;

#define UNIFORM_BLOCK(name) struct name
#include "shared.glsl"
#undef UNIFORM_BLOCK

static_assert(sizeof(FrameBlock) == 16 * (3 + 1 + 1 + 1 + 2 * MAX_CONSTITUENTS + 2), "std140 has no padding here");
static_assert(sizeof(LightBlock) == 16 * (9 + 8 * MAX_SHADOW_VIEWS), "std140 has no padding here");
static_assert(sizeof(EpipolarBlock) == 16 * 11, "std140 has no padding here");

} // namespace tyndall::blocks
