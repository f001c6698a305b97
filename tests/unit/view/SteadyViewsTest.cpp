// A directional light's shadow maps while the camera turns and moves: texels stay where they are in the world.
#include "ViewScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <scene/ShadowViews.h>
#include <scene/View.h>
#include <scene/WorldGeometry.h>

namespace {

using tyndall::ClipDepth;

constexpr int kTexels = 512;

/// A scene of scattered triangles somewhere in the world, and a camera in it.
struct World {
  host::Scene scene = tests::scatteredTriangles(51, 150, {-30, 0, -30}, {30, 8, 30}, 2);
  tests::Pose pose = tests::restPose(scene);
  glm::dvec3 origin;

  explicit World(const glm::dvec3& at) : origin(at) {
    for (glm::dmat4& matrix : pose)
      matrix[3] += glm::dvec4(at, 0);
  }

  std::vector<tyndall::ShadowView> views(const glm::dvec3& eye, const glm::dvec3& towards, int cascades,
                                         int steadyTexels) const {
    tyndall::Light light;
    light.direction = {0.3, -1, 0.2};
    const tyndall::Camera camera = host::makeLookAt(origin + eye, origin + eye + towards, 50, 1.6, 0.1, 300);
    host::fitShadowViews(light, scene, pose, camera, {false, ClipDepth::NegativeOneToOne, cascades, steadyTexels});
    return light.shadow.views;
  }
};

/// Where in its texel a point of the world lies, 0 to 1 along both sides.
glm::dvec2 placeInTexel(const tyndall::ShadowView& view, const glm::dvec3& point) {
  const glm::dvec4 clip = host::fromMat4(view.clipFromWorld) * glm::dvec4(point, 1);
  return glm::fract((0.5 * glm::dvec2(clip) + 0.5) * double(kTexels));
}

/// Texels between two such places: 0.9 and 0.1 are 0.2 apart.
double apart(const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 distance = glm::abs(a - b);
  const glm::dvec2 least = glm::min(distance, 1.0 - distance);
  return std::max(least.x, least.y);
}

/// How far texels are from where they were at first, at points all over the scene, in texels, and how many whole
/// texels the maps moved by, while a camera turns by a degree and goes on by 0.1 from step to step.
struct Drift {
  double texels = 0;
  double moved = 0;
};

Drift driftOf(const World& world, int cascades, int steadyTexels) {
  Drift drift;
  tests::Dice dice(52);
  const glm::dvec3 start(2, 3, 25);
  const std::vector<tyndall::ShadowView> first = world.views(start, {0, 0, -1}, cascades, steadyTexels);
  for (int step = 1; step <= 90; ++step) {
    const double angle = glm::radians(double(step));
    const glm::dvec3 towards(std::sin(angle), 0.1 * std::sin(3 * angle), -std::cos(angle));
    const auto views = world.views(start + 0.1 * step * glm::dvec3(-0.3, 0.05, -1), towards, cascades, steadyTexels);
    REQUIRE(views.size() == first.size());
    for (std::size_t i = 0; i < views.size(); ++i)
      for (int k = 0; k < 8; ++k) {
        const glm::dvec3 point = world.origin + dice.inBox({-30, 0, -30}, {30, 8, 30});
        drift.texels = std::max(drift.texels, apart(placeInTexel(views[i], point), placeInTexel(first[i], point)));
        const auto clipX = [&](const tyndall::ShadowView& view) {
          return (host::fromMat4(view.clipFromWorld) * glm::dvec4(point, 1)).x;
        };
        drift.moved = std::max(drift.moved, 0.5 * kTexels * std::abs(clipX(views[i]) - clipX(first[i])));
      }
  }
  return drift;
}

} // namespace

TEST_CASE(
    "texels of steady shadow maps stay in the world while the camera turns and moves, up to 1e6 from its origin") {
  for (const glm::dvec3 origin : {glm::dvec3(0), glm::dvec3(1234.567, 0, -7654.3), glm::dvec3(1e6, 12, -1e6)})
    for (const int cascades : {1, 2, 4}) {
      CAPTURE(origin.x, cascades);
      const World world(origin);
      const Drift steady = driftOf(world, cascades, kTexels);
      CHECK(steady.texels < 1e-4);
      CHECK((cascades == 1 || steady.moved > 10));     // cascades follow the camera
      CHECK(driftOf(world, cascades, 0).texels > 0.4); // as those that are fitted to the view do not
    }
}

TEST_CASE("a steady shadow map keeps its size to the last bit while the camera turns") {
  const World world({1e6, 0, -1e6});
  const auto first = world.views({2, 3, 25}, {0, 0, -1}, 4, kTexels);
  tests::Dice dice(53);
  for (int i = 0; i < 50; ++i) {
    const auto views = world.views({2, 3, 25}, dice.direction(), 4, kTexels);
    for (std::size_t k = 0; k < views.size(); ++k)
      for (const std::size_t element : {0, 1, 4, 5, 8, 9})
        CHECK(views[k].clipFromWorld[element] == first[k].clipFromWorld[element]);
  }
}

TEST_CASE("steady cascades are finer the nearer they are, and no view is outside them") {
  const World world(glm::dvec3(0));
  double finer = 0;
  const auto views = world.views({2, 3, 25}, {0, 0, -1}, 4, kTexels);
  REQUIRE(views.size() == 4);
  for (std::size_t i = 0; i < views.size(); ++i) {
    CHECK(views[i].layer == static_cast<int>(i));
    const glm::dmat4 clipFromWorld = host::fromMat4(views[i].clipFromWorld);
    const double perUnit = glm::length(glm::dvec3(clipFromWorld[0][0], clipFromWorld[1][0], clipFromWorld[2][0]));
    CHECK((i == 0 || perUnit < finer));
    finer = perUnit;
  }
}

TEST_CASE("a steady shadow map of one texel or two holds its casters, too") {
  const World world(glm::dvec3(0));
  for (const int texels : {1, 2}) {
    const auto views = world.views({2, 3, 25}, {0, 0, -1}, 1, texels);
    REQUIRE(views.size() == 1);
    const glm::dmat4 clipFromWorld = host::fromMat4(views[0].clipFromWorld);
    for (const glm::dvec3& corner : host::worldGeometry(world.scene, world.pose).points) {
      const glm::dvec4 clip = clipFromWorld * glm::dvec4(corner, 1);
      CHECK(std::max(std::abs(clip.x), std::abs(clip.y)) <= 1);
    }
  }
}
