#include "ViewScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <scene/ShadowViews.h>
#include <scene/View.h>
#include <scene/WorldGeometry.h>

namespace {

using tyndall::ClipDepth;
using tyndall::LightKind;

constexpr double kMargin = 3e-4; ///< room for the fit's own margin, relative to the box

tyndall::Light lightOf(LightKind kind, const glm::dvec3& position, const glm::dvec3& direction) {
  tyndall::Light light;
  light.kind = kind;
  light.position = {position.x, position.y, position.z};
  light.direction = {direction.x, direction.y, direction.z};
  return light;
}

glm::dvec4 clipOf(const tyndall::ShadowView& view, const glm::dvec3& world) {
  return host::fromMat4(view.clipFromWorld) * glm::dvec4(world, 1);
}

glm::dvec3 ndcOf(const tyndall::ShadowView& view, const glm::dvec3& world) {
  const glm::dvec4 clip = clipOf(view, world);
  return glm::dvec3(clip) / clip.w;
}

/// A camera from which everything within 20 of the origin is in view.
tyndall::Camera distantCamera() { return host::makeLookAt({0, 0, 100}, {0, 0, 0}, 40, 1, 1, 1000); }

/// What the effect asks of a point: is it inside the side planes and not before the near plane, and, but in the last
/// view, not behind the far plane?
bool owns(const tyndall::ShadowView& view, const glm::dvec3& world, bool last) {
  const glm::dvec4 clip = clipOf(view, world);
  return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z >= -clip.w &&
         (last || clip.z <= clip.w);
}

bool isShadowed(const host::WorldGeometry& geometry, const tyndall::Light& light, const glm::dvec3& point) {
  const glm::dvec3 towards = -glm::dvec3(light.direction[0], light.direction[1], light.direction[2]);
  return host::firstHit(geometry, point, towards).has_value();
}

/// A point on the ray through a pixel, anywhere from the eye to `reach`.
glm::dvec3 pointInView(tests::Dice& dice, const tyndall::Camera& camera, double reach) {
  const glm::dmat4 worldFromClip =
      glm::inverse(host::fromMat4(camera.clipFromView) * host::fromMat4(camera.viewFromWorld));
  const double x = dice.between(-1, 1);
  const double y = dice.between(-1, 1);
  const glm::dvec4 from = worldFromClip * glm::dvec4(x, y, -1, 1);
  const glm::dvec4 to = worldFromClip * glm::dvec4(x, y, 0.5, 1);
  const glm::dvec3 start = glm::dvec3(from) / from.w;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(to) / to.w - start);
  return start + direction * (reach * dice.between(0, 1) * dice.between(0, 1));
}

} // namespace

TEST_CASE("a directional view holds every vertex, tightly") {
  tests::Dice dice(11);
  for (int round = 0; round < 20; ++round) {
    const host::Scene scene = tests::scatteredTriangles(round, 60, {-6, -2, -4}, {5, 3, 9}, 0.7);
    const tests::Pose pose = tests::restPose(scene);
    tyndall::Light light = lightOf(LightKind::Directional, {}, dice.direction() * dice.between(0.1, 10));
    host::fitShadowViews(light, scene, pose, distantCamera());
    REQUIRE(light.shadow.views.size() == 1);
    glm::dvec3 low(9);
    glm::dvec3 high(-9);
    for (const glm::dvec3& point : host::worldGeometry(scene, pose).points) {
      const glm::dvec3 ndc = ndcOf(light.shadow.views[0], point);
      low = glm::min(low, ndc);
      high = glm::max(high, ndc);
    }
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(low[axis] > -1);
      CHECK(low[axis] < -1 + kMargin);
      CHECK(high[axis] < 1);
      CHECK(high[axis] > 1 - kMargin);
    }
  }
}

TEST_CASE("a directional view looks along the light with parallel rays") {
  const host::Scene scene = tests::sceneOf(tests::box({-1, -2, -3}, {3, 2, 1}));
  for (const glm::dvec3 direction : {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.3, -0.5, 0.8)}) {
    tyndall::Light light = lightOf(LightKind::Directional, {}, direction);
    host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
    REQUIRE(light.shadow.views.size() == 1);
    const glm::dvec3 a = ndcOf(light.shadow.views[0], {0.5, 0.2, -1});
    const glm::dvec3 b = ndcOf(light.shadow.views[0], glm::dvec3(0.5, 0.2, -1) + 0.1 * direction);
    CHECK(glm::distance(glm::dvec2(a), glm::dvec2(b)) < 1e-12);
    CHECK(b.z > a.z);
  }
}

TEST_CASE("a directional view turns with what it sees") {
  // A plate of 10 x 2 that is turned by half a radian under a light from straight above.
  const glm::vec3 along(std::cos(0.5F), 0, std::sin(0.5F));
  const glm::vec3 across(-along.z, 0, along.x);
  const host::Scene scene = tests::sceneOf(tests::quad(-5.0F * along - across, 10.0F * along, 2.0F * across));
  tyndall::Light light = lightOf(LightKind::Directional, {}, {0, -1, 0});
  host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
  REQUIRE(light.shadow.views.size() == 1);
  const glm::dmat4 clipFromWorld = host::fromMat4(light.shadow.views[0].clipFromWorld);
  const double perWidth = glm::length(glm::dvec3(clipFromWorld[0][0], clipFromWorld[1][0], clipFromWorld[2][0]));
  const double perHeight = glm::length(glm::dvec3(clipFromWorld[0][1], clipFromWorld[1][1], clipFromWorld[2][1]));
  CHECK(4 / (perWidth * perHeight) == Approx(20).epsilon(1e-3));
  CHECK(std::abs(glm::determinant(clipFromWorld)) > 0);
}

TEST_CASE("a caster seen edge on still makes an invertible view") {
  const host::Scene scene = tests::sceneOf(tests::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  tyndall::Light light = lightOf(LightKind::Directional, {}, {0, -1, 0});
  host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
  REQUIRE(light.shadow.views.size() == 1);
  CHECK(std::isfinite(glm::determinant(glm::inverse(host::fromMat4(light.shadow.views[0].clipFromWorld)))));
}

TEST_CASE("no triangle, no view") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
    tyndall::Light light = lightOf(kind, {}, {0, -1, 0});
    light.shadow.views.resize(3);
    host::fitShadowViews(light, host::Scene{}, {}, distantCamera());
    CHECK(light.shadow.views.empty());
  }
}

TEST_CASE("what a camera ray finds in shadow, a shadow view owns") {
  const host::Scene scene = tests::scatteredTriangles(21, 150, {-30, 0, -30}, {30, 8, 30}, 2);
  const tests::Pose pose = tests::restPose(scene);
  const host::WorldGeometry geometry = host::worldGeometry(scene, pose);
  tests::Dice dice(22);
  int shadowed = 0;
  int narrower = 0;
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const glm::dvec3 eye = dice.inBox({-35, 0, -35}, {35, 20, 35});
    const glm::dvec3 target = eye + 10.0 * dice.direction();
    tyndall::Camera camera =
        host::makeLookAt(eye, target, dice.between(10, 80), 1.3, 0.1, round % 2 == 0 ? 300 : INFINITY);
    if (round % 5 == 0) camera.clipFromView = host::toMat4(host::orthographic(8, 5, round % 10 == 0 ? -3 : 1, 90, {}));
    tyndall::Light light = lightOf(LightKind::Directional, {}, dice.direction());
    host::fitShadowViews(light, scene, pose, camera);
    const tyndall::Camera all = host::makeLookAt({0, 500, 0}, {0, 0, 0}, 60, 1, 1, 2000);
    tyndall::Light whole = light;
    host::fitShadowViews(whole, scene, pose, all);
    if (light.shadow.views.empty() ||
        std::abs(glm::determinant(host::fromMat4(light.shadow.views[0].clipFromWorld))) >
            1.5 * std::abs(glm::determinant(host::fromMat4(whole.shadow.views.at(0).clipFromWorld))))
      ++narrower;
    for (const int cascades : {1, 2, 3, 4, -1, -3}) { // negative: as many that are steady
      host::fitShadowViews(light, scene, pose, camera,
                           {false, ClipDepth::NegativeOneToOne, std::abs(cascades), cascades < 0 ? 64 : 0});
      const std::vector<tyndall::ShadowView>& views = light.shadow.views;
      REQUIRE(static_cast<int>(views.size()) <= std::abs(cascades));
      for (int i = 0; i < 900; ++i) {
        const glm::dvec3 point = pointInView(dice, camera, 200);
        if (!isShadowed(geometry, light, point)) continue;
        ++shadowed;
        bool owned = false;
        for (std::size_t k = 0; k < views.size() && !owned; ++k)
          owned = owns(views[k], point, k + 1 == views.size());
        REQUIRE(owned);
      }
    }
  }
  CHECK(shadowed > 2000);
  CHECK(narrower > 20);
}

TEST_CASE("cascades own the shadow below a thin caster, close to it and far from it") {
  const host::Scene scene = tests::sceneOf(tests::quad({-100, 0, -100}, {0, 0, 200}, {200, 0, 0}));
  const tests::Pose pose = tests::restPose(scene);
  const host::WorldGeometry geometry = host::worldGeometry(scene, pose);
  tests::Dice dice(24);
  for (const double height : {-0.5, -6.0})
    for (const glm::dvec3 direction : {glm::dvec3(0, -1, 0), glm::dvec3(0.2, -1, 0.5)}) {
      const tyndall::Camera camera = host::makeLookAt({0, height, 90}, {0, height, 0}, 60, 1, 0.1, 300);
      tyndall::Light light = lightOf(LightKind::Directional, {}, direction);
      host::fitShadowViews(light, scene, pose, camera, {false, ClipDepth::NegativeOneToOne, 3});
      const std::vector<tyndall::ShadowView>& views = light.shadow.views;
      REQUIRE(views.size() == 3);
      for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 point = pointInView(dice, camera, 250);
        if (!isShadowed(geometry, light, point)) continue;
        const bool owned = owns(views[0], point, false) || owns(views[1], point, false) || owns(views[2], point, true);
        REQUIRE(owned);
      }
    }
}

TEST_CASE("each cascade holds all that stands between it and the light") {
  const host::Scene scene = tests::scatteredTriangles(31, 150, {-30, 0, -90}, {30, 12, 0}, 1);
  const tests::Pose pose = tests::restPose(scene);
  const host::WorldGeometry geometry = host::worldGeometry(scene, pose);
  tyndall::Light light = lightOf(LightKind::Directional, {}, {0.3, -1, 0.2});
  const tyndall::Camera camera = host::makeLookAt({0, 5, 5}, {0, 4, -10}, 50, 1.6, 0.1, 200);
  host::fitShadowViews(light, scene, pose, camera, {false, ClipDepth::NegativeOneToOne, 4});
  REQUIRE(light.shadow.views.size() == 4);
  double finer = 0;
  for (int i = 0; i < 4; ++i) {
    CHECK(light.shadow.views[i].layer == i);
    for (const glm::dvec3& point : geometry.points) {
      const glm::dvec3 ndc = ndcOf(light.shadow.views[i], point);
      if (std::abs(ndc.x) <= 1 && std::abs(ndc.y) <= 1) CHECK(std::abs(ndc.z) <= 1);
    }
    const glm::dmat4 clipFromWorld = host::fromMat4(light.shadow.views[i].clipFromWorld);
    const double texelsPerUnit =
        glm::length(glm::dvec3(clipFromWorld[0][0], clipFromWorld[1][0], clipFromWorld[2][0])) *
        glm::length(glm::dvec3(clipFromWorld[0][1], clipFromWorld[1][1], clipFromWorld[2][1]));
    if (i > 0) CHECK(texelsPerUnit < finer);
    finer = texelsPerUnit;
  }
}

TEST_CASE("the depth of a shadow view runs as asked") {
  const host::Scene scene = tests::scatteredTriangles(41, 80, {-5, -5, -5}, {5, 5, 5}, 1);
  const tests::Pose pose = tests::restPose(scene);
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Point})
    for (const bool reversed : {false, true})
      for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
        CAPTURE(static_cast<int>(kind), reversed, static_cast<int>(clipDepth));
        tyndall::Light light = lightOf(kind, {0, 9, 0}, {0.1, -1, 0.1});
        host::fitShadowViews(light, scene, pose, distantCamera(), {reversed, clipDepth, 1});
        REQUIRE_FALSE(light.shadow.views.empty());
        CHECK(light.shadow.clipDepth == clipDepth);
        const double lowest = clipDepth == ClipDepth::ZeroToOne ? 0 : -1;
        double low = 9;
        double high = -9;
        for (const tyndall::ShadowView& view : light.shadow.views)
          for (const glm::dvec3& point : host::worldGeometry(scene, pose).points) {
            const glm::dvec4 clip = clipOf(view, point);
            if (clip.w <= 0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            low = std::min(low, clip.z / clip.w);
            high = std::max(high, clip.z / clip.w);
          }
        CHECK(low >= lowest);
        CHECK(high <= 1);
        // Towards the light is low depth, unless reversed.
        const std::size_t down = kind == LightKind::Point ? 3 : 0;
        const double above = ndcOf(light.shadow.views[down], {0, 4, 0}).z;
        const double below = ndcOf(light.shadow.views[down], {0, -4, 0}).z;
        CHECK((reversed ? above > below : above < below));
      }
}

TEST_CASE("a spot's cone lies inside its view") {
  const host::Scene scene = tests::scatteredTriangles(51, 200, {-5, -5, -5}, {5, 5, 5}, 1);
  tests::Dice dice(52);
  for (const double outer : {0.05, 0.5, 1.0, 1.45}) {
    const glm::dvec3 direction = dice.direction();
    tyndall::Light light = lightOf(LightKind::Spot, -6.0 * direction, direction);
    light.outerConeAngle = outer;
    CHECK(host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera()).empty());
    REQUIRE(light.shadow.views.size() == 1);
    const glm::dvec3 across = glm::normalize(glm::cross(direction, glm::dvec3(0.3, 0.5, 0.9)));
    const glm::dvec3 other = glm::cross(direction, across);
    double widest = 0;
    for (int i = 0; i < 360; ++i) {
      const double angle = i * 3.14159265358979323846 / 180;
      const glm::dvec3 rim = direction + std::tan(outer) * (std::cos(angle) * across + std::sin(angle) * other);
      const glm::dvec3 ndc = ndcOf(light.shadow.views[0], -6.0 * direction + rim);
      widest = std::max({widest, std::abs(ndc.x), std::abs(ndc.y)});
    }
    CHECK(widest < 1);
    CHECK(widest > 1 - kMargin);
  }
}

TEST_CASE("a spot's planes hug the casters inside it, in steps of an eighth of an octave") {
  // A floor below the light, far wider than the cone, none of its corners in it; and a wall behind the light.
  std::vector<glm::vec3> corners = tests::quad({-100, -3, -100}, {0, 0, 200}, {200, 0, 0});
  const std::vector<glm::vec3> wall = tests::quad({-100, 1, -100}, {0, 0, 200}, {200, 0, 0});
  corners.insert(corners.end(), wall.begin(), wall.end());
  const host::Scene scene = tests::sceneOf(corners);
  tyndall::Light light = lightOf(LightKind::Spot, {0, 0, 0}, {0, -1, 0});
  host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
  REQUIRE(light.shadow.views.size() == 1);
  const double step = std::exp2(1.0 / 8);
  CHECK(ndcOf(light.shadow.views[0], {0, -3 * (1 - kMargin) / step, 0}).z < -1);
  CHECK(ndcOf(light.shadow.views[0], {0, -3, 0}).z > -1);
  CHECK(ndcOf(light.shadow.views[0], {0, -3, 0}).z < 1);
  CHECK(ndcOf(light.shadow.views[0], {0, -3 * (1 + kMargin) * step, 0}).z > 1);
}

TEST_CASE("a spot wider than a map can be is noted, and one that lights nothing has no view") {
  const host::Scene scene = tests::sceneOf(tests::quad({-9, -3, -9}, {0, 0, 18}, {18, 0, 0}));
  tyndall::Light light = lightOf(LightKind::Spot, {0, 0, 0}, {0, -1, 0});
  light.outerConeAngle = 1.5707963267948966;
  CHECK(host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera()).size() == 1);
  REQUIRE(light.shadow.views.size() == 1);
  light = lightOf(LightKind::Spot, {0, 0, 0}, {0, 1, 0});
  CHECK(host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera()).empty());
  CHECK(light.shadow.views.empty());
  light = lightOf(LightKind::Spot, {0, 0, 0}, {0, -1, 0});
  light.range = 2;
  host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
  CHECK(light.shadow.views.empty());
}

TEST_CASE("a point light's six views cover the sphere and agree at their edges") {
  const glm::dvec3 position(1, 2, 3);
  const host::Scene scene = tests::scatteredTriangles(61, 300, {-7, -7, -7}, {8, 8, 8}, 1);
  tyndall::Light light = lightOf(LightKind::Point, position, {0, -1, 0});
  host::fitShadowViews(light, scene, tests::restPose(scene), distantCamera());
  REQUIRE(light.shadow.views.size() == 6);
  const auto viewsOf = [&](const glm::dvec3& direction, double slack) {
    std::vector<glm::dvec3> inside;
    for (const tyndall::ShadowView& view : light.shadow.views) {
      const glm::dvec4 clip = clipOf(view, position + 5.0 * direction);
      if (clip.w > 0 && std::abs(clip.x) <= clip.w * (1 + slack) && std::abs(clip.y) <= clip.w * (1 + slack))
        inside.push_back(glm::dvec3(clip) / clip.w);
    }
    return inside;
  };
  tests::Dice dice(62);
  for (int i = 0; i < 2000; ++i)
    REQUIRE(viewsOf(dice.direction(), 0).size() == 1);
  for (int i = 0; i < 500; ++i) {
    const double t = dice.between(-0.99, 0.99);
    const double a = i % 2 == 0 ? 1 : -1;
    const double b = i % 4 < 2 ? 1 : -1;
    const glm::dvec3 edge = i % 3 == 0 ? glm::dvec3(a, b, t) : i % 3 == 1 ? glm::dvec3(t, a, b) : glm::dvec3(b, t, a);
    const std::vector<glm::dvec3> inside = viewsOf(edge, 1e-12);
    REQUIRE(inside.size() == 2);
    CHECK(inside[0].z == Approx(inside[1].z).margin(1e-12));
    for (const glm::dvec3& ndc : inside)
      CHECK(std::max(std::abs(ndc.x), std::abs(ndc.y)) == Approx(1));
  }
}

TEST_CASE("a point light's planes cut no caster") {
  const host::Scene scene = tests::scatteredTriangles(71, 120, {-3, -3, -3}, {3, 3, 3}, 0.8);
  const tests::Pose pose = tests::restPose(scene);
  const host::WorldGeometry geometry = host::worldGeometry(scene, pose);
  const glm::dvec3 position(0.1, 0.2, -0.1);
  tyndall::Light light = lightOf(LightKind::Point, position, {0, -1, 0});
  host::fitShadowViews(light, scene, pose, distantCamera());
  tests::Dice dice(72);
  for (int i = 0; i < 20000; ++i) {
    const auto [a, b, c] = geometry.triangle(i % geometry.triangleCount());
    const double u = dice.between(0, 1);
    const double v = dice.between(0, 1 - u);
    const glm::dvec3 point = a + u * (b - a) + v * (c - a);
    for (const tyndall::ShadowView& view : light.shadow.views) {
      const glm::dvec4 clip = clipOf(view, point);
      if (clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w) REQUIRE(std::abs(clip.z) <= clip.w);
    }
  }
}

TEST_CASE("fitting is deterministic") {
  const host::Scene scene = tests::scatteredTriangles(81, 100, {-6, -2, -4}, {5, 3, 9}, 0.7);
  tyndall::Light light = lightOf(LightKind::Directional, {}, {0.3, -1, 0.2});
  tyndall::Light again = light;
  const tyndall::Camera camera = host::makeLookAt({0, 1, 5}, {0, 0, 0}, 40, 1, 0.1, 100);
  host::fitShadowViews(light, scene, tests::restPose(scene), camera, {false, ClipDepth::NegativeOneToOne, 3});
  host::fitShadowViews(again, scene, tests::restPose(scene), camera, {false, ClipDepth::NegativeOneToOne, 3});
  REQUIRE(light.shadow.views.size() == again.shadow.views.size());
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i)
    CHECK(light.shadow.views[i].clipFromWorld == again.shadow.views[i].clipFromWorld);
}
