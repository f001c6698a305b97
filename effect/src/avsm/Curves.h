// What a curve is to shaders.
#pragma once

#include "gl/Variant.h"

#include <tyndall/avsm.h>

namespace tyndall::avsm {

inline constexpr int kMaxNodes = 16; ///< a multiple of 4, as all numbers of nodes

inline gl::Definitions curveDefinitions(int nodes, bool packed) {
  return {{"TYNDALL_CURVE_NODES", nodes}, {"TYNDALL_CURVE_PACKED", packed ? 1 : 0}};
}

/// Layers of the curves' texture.
inline int curveLayersOf(const AvsmConfig& config) { return config.layers * config.nodes / (config.packed ? 4 : 2); }

inline constexpr int kSpareNodes = 8; ///< of CurveReduction::Fitted, until all segments are in

/// Of passes/avsmInsert.comp.
inline gl::Definitions insertDefinitions(int nodes, bool packed, bool spare) {
  gl::Definitions definitions = curveDefinitions(nodes, packed);
  definitions.emplace_back("SPARE", spare ? kSpareNodes : 0);
  return definitions;
}

/// Of passes/avsmVolumes.comp, which captures, or inserts into curves.
inline gl::Definitions volumeDefinitions(int nodes, bool packed, bool streamed) {
  gl::Definitions definitions = streamed ? curveDefinitions(nodes, packed) : gl::Definitions{};
  definitions.emplace_back("STREAMED", streamed ? 1 : 0);
  return definitions;
}

} // namespace tyndall::avsm
