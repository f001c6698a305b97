// Banks of fog in boxes and spheres: where each is in a pose, and the density that fills it.
#pragma once

#include "scene/Scene.h"

#include <cstdint>
#include <vector>

namespace host {

/// Density of a bank on a grid that fills its cube, x the fastest, then y: 255 is 1.
struct FogGrid {
  glm::ivec3 size{0}; ///< 0 of an even bank
  std::vector<std::uint8_t> values;
};

/// Smooth noise of so many billows by axis, in four octaves, of which a share is clear.
FogGrid fogGrid(const FogBank& bank);

/// A box around each bank in a pose, in the world.
std::vector<Bounds> fogBounds(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode);

} // namespace host
