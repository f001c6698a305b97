// Ground from a grid of heights: its points and normals, and what covers it.
#pragma once

#include "Erosion.h"
#include "MeshBuilder.h"

#include <glm/glm.hpp>
#include <vector>

namespace scenes {

struct Ground {
  HeightField field;
  glm::dvec3 point(int x, int y) const;
  glm::dvec3 normal(int x, int y) const;
  /// Between points, bilinear; of places beyond the border that of the border.
  double height(const glm::dvec2& place) const;
};

/// What covers a triangle: a place in the list of materials, for its middle, the ground's normal and a chance in [0,
/// 1), which frays borders.
using CoverAt = int (*)(const glm::dvec3& middle, const glm::dvec3& normal, double chance);

/// Both triangles of each cell, material by material.
void cover(MeshBuilder& mesh, const Ground& ground, CoverAt coverAt, const std::vector<int>& materials);

/// The colour of a point, 0 to 1, for the ground's normal there.
using ColourAt = glm::dvec3 (*)(const glm::dvec3& point, const glm::dvec3& normal);

/// Both triangles of each cell, of the mesh's material, with a colour at each point.
void paint(MeshBuilder& mesh, const Ground& ground, ColourAt colourAt);

} // namespace scenes
