#include "ViewScenes.h"
#include "support/Catch.h"

#include <cmath>
#include <scene/ConvexPolygon.h>

namespace {

double areaOf(const std::vector<glm::dvec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

double areaOf(const host::Rectangle& rectangle) { return 4 * rectangle.halfSize.x * rectangle.halfSize.y; }

const std::vector<glm::dvec2> kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

} // namespace

TEST_CASE("the hull of a square's corners, sides and inside is the square") {
  const std::vector<glm::dvec2> hull =
      host::convexHull({{1, 1}, {2, 2}, {0, 0}, {1, 0}, {0, 2}, {2, 0}, {2, 1}, {0, 0}, {0.3, 1.7}});
  CHECK(hull.size() == 4);
  CHECK(areaOf(hull) == Approx(4));
}

TEST_CASE("hulls of too few points") {
  CHECK(host::convexHull({}).empty());
  CHECK(host::convexHull({{1, 2}, {1, 2}}).size() == 1);
  CHECK(host::convexHull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size() == 2);
}

TEST_CASE("the hull holds every point") {
  tests::Dice dice(7);
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 500; ++i)
    points.emplace_back(dice.direction() * dice.between(0, 1));
  const std::vector<glm::dvec2> hull = host::convexHull(points);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec2 side = hull[(i + 1) % hull.size()] - hull[i];
    for (const glm::dvec2& point : points)
      REQUIRE(side.x * (point.y - hull[i].y) - side.y * (point.x - hull[i].x) >= -1e-12);
  }
}

TEST_CASE("a half plane cuts a square in known parts") {
  CHECK(areaOf(host::cut(kSquare, {1, 0, -0.5})) == Approx(3));
  CHECK(areaOf(host::cut(kSquare, {-1, -1, 2})) == Approx(2));
  CHECK(host::cut(kSquare, {1, 0, -3}).empty());
  CHECK(areaOf(host::cut(kSquare, {1, 0, 3})) == Approx(4));
}

TEST_CASE("the smallest rectangle around a turned rectangle is itself") {
  for (const double angle : {0.0, 0.3, 1.2, 2.9}) {
    CAPTURE(angle);
    const glm::dvec2 axis(std::cos(angle), std::sin(angle));
    const glm::dvec2 normal(-axis.y, axis.x);
    const glm::dvec2 centre(4, -7);
    const host::Rectangle rectangle =
        host::smallestRectangle(host::convexHull({centre + 3.0 * axis + normal, centre - 3.0 * axis + normal,
                                                  centre - 3.0 * axis - normal, centre + 3.0 * axis - normal}));
    CHECK(areaOf(rectangle) == Approx(12));
    CHECK(glm::distance(rectangle.centre, centre) < 1e-12);
    CHECK(glm::length(rectangle.axis) == Approx(1));
  }
}

TEST_CASE("the smallest rectangle of a line or a point has no area") {
  CHECK(areaOf(host::smallestRectangle({{1, 1}, {4, 5}})) == Approx(0).margin(1e-12));
  CHECK(areaOf(host::smallestRectangle({{1, 1}})) == 0);
}
