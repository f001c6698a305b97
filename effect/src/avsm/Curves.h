// What a curve is to shaders.
#pragma once

#include "gl/Variant.h"

namespace tyndall::avsm {

inline constexpr int kMaxNodes = 16; ///< a multiple of 4, as all numbers of nodes

inline gl::Definitions curveDefinitions(int nodes, bool packed) {
  return {{"TYNDALL_CURVE_NODES", nodes}, {"TYNDALL_CURVE_PACKED", packed ? 1 : 0}};
}

} // namespace tyndall::avsm
