// Boxes around meshes (optics/MeshBox.h).
#include "optics/MeshBox.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

using tyndall::optics::boxAround;

namespace {

bool holds(const glm::dmat4& box, const glm::vec3& point) {
  const glm::dvec4 p = glm::inverse(box) * glm::dvec4(glm::dvec3(point), 1);
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= 1 + 1e-12;
}

double volumeOf(const glm::dmat4& box) { return 8 * std::abs(glm::determinant(glm::dmat3(box))); }

// Points of a cuboid that is turned, its corners among them.
std::vector<glm::vec3> turnedCuboid(const glm::dvec3& half, const glm::dvec3& middle) {
  const glm::dmat4 placed =
      glm::rotate(glm::translate(glm::dmat4(1), middle), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  std::vector<glm::vec3> points;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1, 1);
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 corner((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    const glm::dvec3 inside(within(random), within(random), within(random));
    points.emplace_back(glm::dvec3(placed * glm::dvec4(half * (i < 200 ? corner : inside), 1)));
  }
  return points;
}

} // namespace

TEST_CASE("a box holds all points, and fits a turned cuboid closely") {
  const glm::dvec3 half(4, 1, 0.3);
  for (const glm::dvec3& middle : {glm::dvec3(0), glm::dvec3(1e4, -200, 3)}) {
    const std::vector<glm::vec3> points = turnedCuboid(half, middle);
    const glm::dmat4 box = boxAround(points);
    for (const glm::vec3& p : points)
      REQUIRE(holds(box, p));
    const double upright = 8 * 4 * 2.5 * 2.5; // what the axes of coordinates would need, and more
    CHECK(volumeOf(box) < 1.3 * 8 * half.x * half.y * half.z);
    CHECK(volumeOf(box) < 0.5 * upright);
  }
}

TEST_CASE("a cuboid along the axes of coordinates keeps its box") {
  const std::vector<glm::vec3> points = {{-1, 0, 2}, {3, 0, 2}, {-1, 5, 2}, {3, 5, 2}, {-1, 0, 3}, {3, 5, 3}};
  CHECK(volumeOf(boxAround(points)) == Approx(4 * 5 * 1).epsilon(1e-6));
}

TEST_CASE("flat meshes, lines and single points get a box of some thickness") {
  const std::vector<std::vector<glm::vec3>> meshes = {
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}}, {{5, 5, 5}, {6, 7, 8}}, {{0, 0, 0}}, {{1e6F, 2, 3}, {1e6F, 2, 3}}};
  for (const std::vector<glm::vec3>& points : meshes) {
    const glm::dmat4 box = boxAround(points);
    CHECK(volumeOf(box) > 0);
    for (const glm::vec3& p : points)
      CHECK(holds(box, p));
  }
}
