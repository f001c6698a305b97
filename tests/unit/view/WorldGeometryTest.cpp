#include "ViewScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/Projection.h>
#include <scene/WorldGeometry.h>

namespace {

host::WorldGeometry geometryOf(const std::vector<glm::vec3>& corners) {
  const host::Scene scene = tests::sceneOf(corners);
  return host::worldGeometry(scene, tests::restPose(scene));
}

const glm::dmat4 kIdentity(1);

} // namespace

TEST_CASE("world geometry follows the pose and leaves out what no triangle uses") {
  host::Scene scene = tests::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}});
  scene.meshes[0].primitives[0].indices = {2, 0, 1};
  scene.nodes.push_back(scene.nodes[0]);
  const host::WorldGeometry geometry =
      host::worldGeometry(scene, {kIdentity, glm::translate(kIdentity, glm::dvec3(10, 0, 0))});
  CHECK(geometry.points.size() == 6);
  REQUIRE(geometry.triangleCount() == 2);
  CHECK(geometry.triangle(1)[0] == glm::dvec3(10, 1, 0));
  CHECK(geometry.triangle(1)[2] == glm::dvec3(11, 0, 0));
}

TEST_CASE("world geometry holds no points and lines") {
  host::Scene scene = tests::sceneOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  scene.meshes[0].primitives[0].topology = host::Topology::Lines;
  CHECK(host::worldGeometry(scene, tests::restPose(scene)).points.empty());
}

TEST_CASE("the depth range in a pyramid is that of the part inside") {
  // Across the whole view at depth 3.
  const auto facing =
      host::depthRangeInPyramid(geometryOf({{-90, -90, -3}, {90, -90, -3}, {0, 90, -3}}), kIdentity, 1, 1);
  REQUIRE(facing);
  CHECK(facing->nearest == Approx(3));
  CHECK(facing->farthest == Approx(3));

  // A floor one below the eye, from behind it to far in front: it enters a pyramid of tangent 0.5 at depth 2.
  const auto floor =
      host::depthRangeInPyramid(geometryOf(tests::quad({-50, -1, 40}, {100, 0, 0}, {0, 0, -80})), kIdentity, 0.5, 0.5);
  REQUIRE(floor);
  CHECK(floor->nearest == Approx(2));
  CHECK(floor->farthest == Approx(40));

  CHECK_FALSE(host::depthRangeInPyramid(geometryOf({{-1, -1, 3}, {1, -1, 3}, {0, 1, 3}}), kIdentity, 1, 1));
  CHECK_FALSE(host::depthRangeInPyramid(geometryOf({{5, 0, -3}, {6, 0, -3}, {5, 1, -3}}), kIdentity, 1, 1));
}

TEST_CASE("the depth range holds every point of every triangle inside") {
  const host::Scene scene = tests::scatteredTriangles(3, 300, {-4, -4, -4}, {4, 4, 4}, 1);
  const host::WorldGeometry geometry = host::worldGeometry(scene, tests::restPose(scene));
  const glm::dmat4 viewFromWorld = host::viewLooking({0.3, 0.1, 4.5}, {0.2, -0.1, -1});
  const auto range = host::depthRangeInPyramid(geometry, viewFromWorld, 0.7, 0.4);
  REQUIRE(range);
  tests::Dice dice(4);
  double nearest = 1e9;
  double farthest = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto [a, b, c] = geometry.triangle(i % geometry.triangleCount());
    const double u = dice.between(0, 1);
    const double v = dice.between(0, 1 - u);
    const glm::dvec4 view = viewFromWorld * glm::dvec4(a + u * (b - a) + v * (c - a), 1);
    if (std::abs(view.x) > -0.7 * view.z || std::abs(view.y) > -0.4 * view.z) continue;
    nearest = std::min(nearest, -view.z);
    farthest = std::max(farthest, -view.z);
  }
  CHECK(nearest >= range->nearest);
  CHECK(farthest <= range->farthest);
  CHECK(nearest == Approx(range->nearest).margin(0.1));
  CHECK(farthest == Approx(range->farthest).margin(0.1));
}

TEST_CASE("a ray's first hit and the side it meets") {
  const host::WorldGeometry geometry = geometryOf(tests::box({-1, -1, -1}, {1, 1, 1}));
  const auto outside = host::firstHit(geometry, {0.2, 0.3, 5}, {0, 0, -1});
  REQUIRE(outside);
  CHECK(outside->distance == Approx(4));
  CHECK(outside->front);
  for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
                                     glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
    const auto inside = host::firstHit(geometry, {0.1, 0.2, 0.3}, direction);
    REQUIRE(inside);
    CHECK_FALSE(inside->front);
    CHECK(inside->distance == Approx(1 - glm::dot(direction, glm::dvec3(0.1, 0.2, 0.3))));
  }
  CHECK_FALSE(host::firstHit(geometry, {0, 0, 5}, {0, 0, 1}));
}

TEST_CASE("boxes hold the scene, and no more than the bounds of its primitives") {
  host::Scene scene = tests::scatteredTriangles(3, 200, {-1, -2, -3}, {3, 2, 1}, 0.4);
  scene.textures.resize(3);
  const host::Scene boxes = host::boxesOf(scene);
  const tests::Pose pose = {glm::translate(kIdentity, glm::dvec3(5, 6, 7))};
  const host::Bounds bounds = host::boundsOf(scene, pose), held = host::boundsOf(boxes, pose);
  CHECK(glm::length(bounds.low - held.low) < 1e-12);
  CHECK(glm::length(bounds.high - held.high) < 1e-12);
  CHECK(boxes.textures.empty());
  CHECK(boxes.materials.size() == scene.materials.size());
  const host::WorldGeometry box = host::worldGeometry(boxes, pose);
  CHECK(box.triangleCount() == 12);
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  for (const glm::dvec3& way : {glm::dvec3(1, 0.1, 0.2), glm::dvec3(-0.3, 1, 0.1), glm::dvec3(0.1, 0.2, -1)}) {
    CHECK_FALSE(host::firstHit(box, middle, way)->front); // seen from inside
    CHECK(host::firstHit(box, middle + 100.0 * way, -way)->front);
  }
}
