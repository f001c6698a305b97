// Scenes as a light sees them: the segments of a map's texels, made without a renderer, the same on every machine.
#pragma once

#include "reference/Curves.h"

#include <cstdint>
#include <string>
#include <vector>

namespace avsmbench {

/// What tyndallCapture() is given, in the order of drawing.
struct DrawnSegment {
  std::uint32_t texel = 0; ///< y * size + x
  float entry = 0, exit = 0, transmittance = 1;
};

struct MapScene {
  std::string name;
  int size = 0; ///< texels per side
  std::vector<DrawnSegment> segments;
};

/// "smoke": three columns of soft puffs, which shade one another. "hair": strands that let little through, in thin
/// smoke. Each fills the light's range of depths; with "-tenth" behind the name only a tenth of it.
const std::vector<std::string>& mapSceneNames();
MapScene makeMapScene(const std::string& name, int size);

/// The segments of each texel.
std::vector<std::vector<reference::Segment>> segmentsByTexel(const MapScene& scene);

} // namespace avsmbench
