// Masonry: walls with arched openings, coursed stone, vaults, columns.
#pragma once

#include "MeshBuilder.h"

namespace scenes {

using Outline = std::vector<glm::dvec2>; ///< a polygon in a wall's plane, counter-clockwise

/// The part of a convex polygon with dot(point, normal) <= offset.
Outline clip(const Outline& polygon, const glm::dvec2& normal, double offset);

/// The pointed arch of half span 1 and a rise of `ratio` >= 1, scaled to height 1: its height at |u| <= 1.
double pointedArch(double u, double ratio);

/// The crown of a pointed arch, left to right, `segments` a side; rise >= half span.
Outline archCurve(double centre, double halfSpan, double spring, double rise, int segments);
Outline circleCurve(const glm::dvec2& centre, double radius, int segments);
std::vector<glm::dvec3> atDepth(const Outline& curve, double z);

/// A hole in a wall: abscissae from left to right with the heights of its lower and upper edge.
struct Opening {
  std::vector<double> x;
  std::vector<double> low;
  std::vector<double> high;
  Outline outline() const;
};
Opening lancet(double centre, double halfSpan, double sill, double spring, double rise, int segments);
Opening roundOpening(const glm::dvec2& centre, double radius, int segments);
Opening between(const Opening& a, const Opening& b, double weight);

/// A wall across its local z, from `back` to `front`.
struct Panel {
  double left = 0;
  double right = 0;
  double bottom = 0;
  double top = 0;
  double back = 0;
  double front = 0;
};

/// Several tones of one stone; blocks take one by chance.
struct Masonry {
  std::vector<int> tones;
  double length = 0.95; ///< of a block
  double height = 0.42; ///< of a course
  int pick(int column, int row, int seed) const;
};

/// A wall with a splayed hole, both faces and the reveals, the front face coursed.
void wall(MeshBuilder& mesh, const Masonry& stone, const Panel& panel, const Opening& front, const Opening& back,
          int seed);
/// A wall without a hole.
void wall(MeshBuilder& mesh, const Masonry& stone, const Panel& panel, int seed);

/// A pointed rib vault over [-halfX, halfX] x [-halfZ, halfZ], seen from below, with diagonal ribs.
struct Vault {
  double halfX = 1;
  double halfZ = 1;
  double spring = 0;
  double rise = 1;
  double rib = 0.2; ///< width of a rib
};
void vault(MeshBuilder& mesh, const Masonry& stone, int ribs, const Vault& vault, int seed);
/// The arch that spans x at the frame's z = 0.
void transverseArch(MeshBuilder& mesh, const Vault& vault, double width, double depth);

/// A round column about y with base and capital; `top` is the upper face of its abacus.
void column(MeshBuilder& mesh, const Masonry& stone, double radius, double top, int sides, int seed);

} // namespace scenes
