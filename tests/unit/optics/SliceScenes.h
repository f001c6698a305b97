// What a table of slices says, read plainly, for tests.
#pragma once

#include "optics/Slices.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tests {

struct SliceEnds {
  glm::dvec2 entry, exit;
};

inline SliceEnds sliceEnds(const tyndall::optics::SliceTable& table, int slice) {
  const glm::dvec4 ends(table.texels[static_cast<std::size_t>(slice)]);
  return {{ends.x, ends.y}, {ends.z, ends.w}};
}

/// From a slice's line, which ends at an epipole in the image; pixels.
inline double distanceTo(const tyndall::optics::SliceTable& table, int slice, const glm::dvec2& p) {
  const SliceEnds ends = sliceEnds(table, slice);
  const glm::dvec2 along = ends.exit - ends.entry;
  const double share = glm::dot(p - ends.entry, along) / std::max(glm::dot(along, along), 1e-12);
  const double least = table.block.slicesClosed ? 0 : -1e9;
  return glm::distance(p, ends.entry + std::max(share, least) * along);
}

struct NearestSlice {
  int slice = 0;
  double distance = 1e300;
};

/// By trying all of them.
inline NearestSlice nearestSlice(const tyndall::optics::SliceTable& table, const glm::dvec2& p) {
  NearestSlice nearest;
  for (int i = 0; i < table.slices; ++i)
    if (const double distance = distanceTo(table, i, p); distance < nearest.distance) nearest = {i, distance};
  return nearest;
}

/// True if no number of the table or its block is infinite or none. All of the block but its integers are floats.
inline bool isFinite(const tyndall::optics::SliceTable& table) {
  const bool texels = std::all_of(table.texels.begin(), table.texels.end(), [](const glm::vec4& t) {
    return std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z) && std::isfinite(t.w);
  });
  float words[sizeof table.block / 4];
  std::memcpy(words, &table.block, sizeof words);
  return texels && std::all_of(std::begin(words), std::end(words), [](float word) { return std::isfinite(word); });
}

} // namespace tests
