#include <scene/ConvexPolygon.h>

#include <algorithm>
#include <limits>

namespace host {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

Rectangle rectangleAlong(const std::vector<glm::dvec2>& polygon, const glm::dvec2& axis) {
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  const glm::dvec2 normal(-axis.y, axis.x);
  for (const glm::dvec2& corner : polygon) {
    const glm::dvec2 along(glm::dot(corner, axis), glm::dot(corner, normal));
    low = glm::min(low, along);
    high = glm::max(high, along);
  }
  const glm::dvec2 middle = 0.5 * (low + high);
  return {middle.x * axis + middle.y * normal, axis, 0.5 * (high - low)};
}

} // namespace

// Andrew's monotone chain.
std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;

  std::vector<glm::dvec2> hull;
  const auto extend = [&hull](const glm::dvec2& point, std::size_t fixed) {
    while (hull.size() > fixed && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const glm::dvec2& point : points)
    extend(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point)
    extend(*point, lower);
  hull.pop_back();
  return hull;
}

std::vector<glm::dvec2> cut(const std::vector<glm::dvec2>& polygon, const HalfPlane& halfPlane) {
  const auto height = [&halfPlane](const glm::dvec2& p) { return halfPlane.a * p.x + halfPlane.b * p.y + halfPlane.c; };
  std::vector<glm::dvec2> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 p = polygon[i];
    const glm::dvec2 q = polygon[(i + 1) % polygon.size()];
    const double hp = height(p);
    const double hq = height(q);
    if (hp >= 0) inside.push_back(p);
    if ((hp >= 0) != (hq >= 0)) inside.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  return inside;
}

Rectangle smallestRectangle(const std::vector<glm::dvec2>& polygon) {
  Rectangle best = rectangleAlong(polygon, {1, 0});
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 side = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (side == glm::dvec2(0)) continue;
    const Rectangle candidate = rectangleAlong(polygon, glm::normalize(side));
    if (candidate.halfSize.x * candidate.halfSize.y < best.halfSize.x * best.halfSize.y) best = candidate;
  }
  return best;
}

} // namespace host
