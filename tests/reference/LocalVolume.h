// Fog and smoke within a box or a sphere (tyndall/avsm.h, AvsmVolume), in double precision.
#pragma once

#include <glm/glm.hpp>
#include <tyndall/avsm.h>
#include <vector>

namespace reference {

/// What a volume's density texture holds, x the fastest, then y; size 0: it has none.
struct DensityGrid {
  glm::ivec3 size{0};
  std::vector<float> values;
};

/// Density at a place of the volume's own coordinates, with what it has faded; 0 outside.
double densityAt(const tyndall::AvsmVolume& volume, const DensityGrid& grid, const glm::dvec3& place);

/// Optical depth of the way between two points of the world: by Gauss quadrature between all planes of the grid and of
/// the fade, exact to about 1e-9 of a box.
double opticalDepth(const tyndall::AvsmVolume& volume, const DensityGrid& grid, const glm::dvec3& from,
                    const glm::dvec3& to);

} // namespace reference
