// Stained glass: windows as single sheets of coloured panes with lead between them.
#pragma once

#include "Architecture.h"

namespace scenes {

struct Glass {
  std::vector<int> reds;
  std::vector<int> blues;
  std::vector<int> golds;
  std::vector<int> greens;
  int lead = 0;
};

/// The palette's materials, and the lead.
Glass addGlass(Scene& scene);

/// Fills a convex outline at depth z with panes that reach a little into the stone around it.
void glazeLancet(MeshBuilder& mesh, const Glass& glass, const Outline& outline, double z, int seed);
/// Fills a circle with rings of panes, `petals` round the hub.
void glazeRose(MeshBuilder& mesh, const Glass& glass, const glm::dvec2& centre, double radius, int petals, double z);

} // namespace scenes
