#include "scene/Fog.h"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

/// A number in [0, 1) of a lattice point.
double valueAt(const glm::ivec3& point, std::uint32_t seed) {
  std::uint32_t bits = seed;
  for (int axis = 0; axis < 3; ++axis) {
    bits = (bits ^ static_cast<std::uint32_t>(point[axis])) * 0x9E3779B1U;
    bits ^= bits >> 15;
  }
  bits *= 0x85EBCA6BU;
  return (bits ^ (bits >> 13)) / 4294967296.0;
}

/// Between lattice points by Hermite's cubic.
double noise(const glm::dvec3& place, std::uint32_t seed) {
  const glm::dvec3 low = glm::floor(place), f = place - low, t = f * f * (3.0 - 2.0 * f);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis)
      weight *= step[axis] == 1 ? t[axis] : 1 - t[axis];
    sum += weight * valueAt(glm::ivec3(low) + step, seed);
  }
  return sum;
}

} // namespace

FogGrid fogGrid(const FogBank& bank) {
  FogGrid grid;
  if (bank.billows == glm::ivec3(0)) return grid;
  constexpr int kTexels = 12, kMost = 128, kOctaves = 4; // a billow
  grid.size = glm::clamp(kTexels * bank.billows, glm::ivec3(4), glm::ivec3(kMost));
  grid.values.reserve(static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y) *
                      static_cast<std::size_t>(grid.size.z));
  for (int z = 0; z < grid.size.z; ++z)
    for (int y = 0; y < grid.size.y; ++y)
      for (int x = 0; x < grid.size.x; ++x) {
        glm::dvec3 place = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(grid.size) * glm::dvec3(bank.billows);
        double sum = 0, whole = 0, strength = 1;
        for (int octave = 0; octave < kOctaves; ++octave) {
          sum += strength * noise(place, static_cast<std::uint32_t>(bank.seed) + static_cast<std::uint32_t>(octave));
          whole += strength;
          strength *= 0.5;
          place *= 2.03;
        }
        // Noise lies about a half, a tenth to either side.
        const double t = std::clamp((sum / whole - 0.25 - 0.5 * bank.clear) / 0.35, 0.0, 1.0);
        grid.values.push_back(static_cast<std::uint8_t>(std::lround(255 * t * t * (3 - 2 * t))));
      }
  return grid;
}

std::vector<Bounds> fogBounds(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode) {
  std::vector<Bounds> all;
  for (const FogBank& bank : scene.fog) {
    const glm::dmat4& matrix = worldFromNode[static_cast<std::size_t>(bank.node)];
    glm::dvec3 reach(0);
    for (int axis = 0; axis < 3; ++axis)
      reach += glm::abs(glm::dvec3(matrix[axis]));
    all.push_back({glm::dvec3(matrix[3]) - reach, glm::dvec3(matrix[3]) + reach});
  }
  return all;
}

} // namespace host
