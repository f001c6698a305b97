// Convex polygons in the plane.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace host {

/// The smallest convex polygon around points, counter-clockwise; fewer than three corners if they lie on a line.
std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points);

/// The half plane a x + b y + c >= 0.
struct HalfPlane {
  double a = 0;
  double b = 0;
  double c = 0;
};

/// The part of a convex polygon inside a half plane; empty if there is none.
std::vector<glm::dvec2> cut(const std::vector<glm::dvec2>& polygon, const HalfPlane& halfPlane);

/// A rectangle in any orientation.
struct Rectangle {
  glm::dvec2 centre{0};
  glm::dvec2 axis{1, 0}; ///< unit, along the width; the height runs along (-axis.y, axis.x)
  glm::dvec2 halfSize{0};
};

/// The rectangle of least area around a convex polygon of one corner or more. One side lies along a side of the
/// polygon.
Rectangle smallestRectangle(const std::vector<glm::dvec2>& polygon);

} // namespace host
