// Mountain ranges that rivers have cut, and the ground's points and normals.
#pragma once

#include "Erosion.h"
#include "MeshBuilder.h"

#include <glm/glm.hpp>

namespace scenes {

struct Range {
  double side = 20000; ///< metres
  double uplift = 250; ///< metres a step where it is strongest
  double detail = 60;  ///< metres of the finest relief, high up
  int seed = 0;
};

/// 601 points a side, about the middle of x and z, y upwards from the rivers' outlets.
HeightField mountains(const Range& range);

struct Ground {
  HeightField field;
  glm::dvec3 point(int x, int y) const;
  glm::dvec3 normal(int x, int y) const;
  /// Between points, bilinear; of places beyond the border that of the border.
  double height(const glm::dvec2& place) const;
};

/// Both triangles of each cell, of the materials that `coverAt` picks: a place in the list for a triangle's middle, the
/// ground's normal and a chance in [0, 1), which frays borders.
void cover(MeshBuilder& mesh, const Ground& ground, int (*coverAt)(const glm::dvec3&, const glm::dvec3&, double),
           const std::vector<int>& materials);

} // namespace scenes
