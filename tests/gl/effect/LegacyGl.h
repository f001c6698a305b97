// GL's names for what the core profile lacks, for tests in the compatibility profile. Functions are looked up by name.
#pragma once

#include "gl/Gl.h"
#include "support/TestContext.h"

#include <string>
#include <type_traits>

namespace tests::legacy {

// NOLINTBEGIN(readability-identifier-naming): GL's names
enum : GLenum {
  ALPHA_TEST = 0x0BC0,
  ALPHA_TEST_FUNC = 0x0BC1,
  ALPHA_TEST_REF = 0x0BC2,
  POLYGON_STIPPLE = 0x0B42,
  LINE_STIPPLE = 0x0B24,
  POINT_SMOOTH = 0x0B10,
  POINT_SPRITE = 0x8861,
  DEPTH_TEXTURE_MODE = 0x884B,
  CLAMP_VERTEX_COLOR = 0x891A,
  CLAMP_FRAGMENT_COLOR = 0x891B,
  CLAMP_READ_COLOR = 0x891C,
  MAP_COLOR = 0x0D10,
  MAP_STENCIL = 0x0D11,
  INDEX_SHIFT = 0x0D12,
  INDEX_OFFSET = 0x0D13,
  RED_SCALE = 0x0D14,
  RED_BIAS = 0x0D15,
  GREEN_SCALE = 0x0D18,
  GREEN_BIAS = 0x0D19,
  BLUE_SCALE = 0x0D1A,
  BLUE_BIAS = 0x0D1B,
  ALPHA_SCALE = 0x0D1C,
  ALPHA_BIAS = 0x0D1D,
  DEPTH_SCALE = 0x0D1E,
  DEPTH_BIAS = 0x0D1F,
  PIXEL_MAP_R_TO_R = 0x0C76, // and those of green, blue and alpha
  STENCIL_TEST_TWO_SIDE = 0x8910,
  ACTIVE_STENCIL_FACE = 0x8911,
  FOG = 0x0B60,
  COLOR_SUM = 0x8458,
  SHADE_MODEL = 0x0B54,
  FLAT = 0x1D00,
  SMOOTH = 0x1D01,
  LIGHTING = 0x0B50,
  NORMALIZE = 0x0BA1,
  VERTEX_PROGRAM_TWO_SIDE = 0x8643,
  VERTEX_PROGRAM = 0x8620,
  FRAGMENT_PROGRAM = 0x8804,
  INDEX_LOGIC_OP = 0x0BF1,
  CLIP_PLANE0 = 0x3000,
  MODELVIEW = 0x1700,
  PROJECTION = 0x1701,
  TEXTURE = 0x1702,
  MATRIX_MODE = 0x0BA0,
  TEXTURE_GEN_S = 0x0C60,
  TEXTURE_2D = 0x0DE1,
  TEXTURE_ENV = 0x2300,
  TEXTURE_ENV_MODE = 0x2200,
  MODULATE = 0x2100,
  TEXTURE_FILTER_CONTROL = 0x8500,
  VERTEX_ARRAY = 0x8074,
  COLOR_ARRAY = 0x8076,
  RENDER_MODE = 0x0C40,
  RENDER = 0x1C00,
  FEEDBACK = 0x1C01,
  SELECT = 0x1C02,
  COMPILE = 0x1300,
  COMPILE_AND_EXECUTE = 0x1301,
  PERSPECTIVE_CORRECTION_HINT = 0x0C50,
};
// NOLINTEND(readability-identifier-naming)

template <typename Argument>
struct Plain {
  using Type = Argument; // as it stands, not deduced
};

/// call<void, GLenum, GLfloat>("glAlphaFunc", GL_GREATER, 0)
template <typename Result, typename... Arguments>
Result call(const char* name, typename Plain<Arguments>::Type... arguments) {
  const auto function = reinterpret_cast<Result(GLAD_API_PTR*)(Arguments...)>(testContext().loader()(name));
  return function(arguments...);
}

} // namespace tests::legacy
