// Trees with every leaf as geometry, and what grows below them.
#pragma once

#include "MeshBuilder.h"
#include "Random.h"

namespace scenes {

struct Foliage {
  std::vector<int> leaves;
  int bark = 0;
};

/// A leaf of two triangles folded along its midrib, from its stalk in direction `along`.
void leaf(MeshBuilder& mesh, const glm::dvec3& stalk, const glm::dvec3& along, const glm::dvec3& across, double length);

struct TreeShape {
  double height = 15;
  double crown = 3.5;   ///< length of the lowest branches
  double bare = 0.35;   ///< part of the trunk without branches
  double radius = 0.25; ///< of the trunk
  int branches = 16;
  int twigs = 6; ///< a branch
  int leavesPerTwig = 16;
  double leafLength = 0.26;
};
void tree(MeshBuilder& mesh, const Foliage& foliage, const TreeShape& shape, Random& random);

void fern(MeshBuilder& mesh, int material, const glm::dvec3& root, double size, Random& random);

} // namespace scenes
