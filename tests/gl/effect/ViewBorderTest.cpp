// Where a light's shadow views end just where its light does, or where the next one begins: no light leaks between. All
// texels are dark, so that any light is a leak.
#include "SceneRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr double kNear = 0.01, kBeam = 10; // where casters are and where cameras look, from the lamp on
const glm::dvec3 kLamp(13.7, 42.1, -8.3), kAxis = glm::normalize(glm::dvec3(0.3, -1, 0.2)),
                                          kSide = glm::normalize(glm::cross(kAxis, glm::dvec3(0, 0, 1)));

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// A matrix as an engine composes it, in double or in float.
Mat4 lookThrough(const glm::dmat4& projection, const glm::dvec3& eye, const glm::dvec3& direction, bool floats) {
  const glm::dvec3 up = std::abs(direction.z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  if (!floats) return tests::toMat4(projection * glm::lookAt(eye, eye + direction, up));
  const glm::mat4 view = glm::lookAt(glm::vec3(eye), glm::vec3(eye) + glm::vec3(direction), glm::vec3(up));
  return tests::toMat4(glm::dmat4(glm::mat4(projection) * view));
}

Light spotAsWideAsItsMap(double angle, bool hard, bool floats) {
  Light light;
  light.kind = LightKind::Spot;
  light.position = toVec3(kLamp);
  light.direction = toVec3(kAxis);
  light.outerConeAngle = angle;
  light.innerConeAngle = hard ? angle : 0.5 * angle;
  light.shadow.views = {{lookThrough(glm::perspective(2 * angle, 1.0, kNear, 60.0), kLamp, kAxis, floats), 0}};
  return light;
}

Light pointInACube(bool floats) {
  Light light;
  light.kind = LightKind::Point;
  light.position = toVec3(kLamp);
  const glm::dmat4 projection = glm::perspective(glm::half_pi<double>(), 1.0, kNear, 60.0);
  for (int i = 0; i < 6; ++i) {
    glm::dvec3 axis(0);
    axis[i / 2] = i % 2 == 0 ? 1 : -1;
    light.shadow.views.push_back({lookThrough(projection, kLamp, axis, floats), 0});
  }
  return light;
}

// Two views that share a side, or all of them.
Light sunThroughTwo(bool same, bool floats) {
  Light light;
  light.direction = toVec3(kAxis);
  const glm::dvec3 eye = kLamp - 30.0 * kAxis;
  for (const bool right : {false, true}) {
    const double low = same || !right ? -8 : 0, high = same || right ? 8 : 0;
    light.shadow.views.push_back({lookThrough(glm::ortho(low, high, -8.0, 8.0, 1.0, 90.0), eye, kAxis, floats), 0});
  }
  return light;
}

struct Eye {
  glm::dvec3 position, direction;
  double fov; // radians
};

// Outside the cone across the beam, in it beside the axis and on it, away from the lamp, and on its very wall along it.
std::vector<Eye> eyesAround(double angle) {
  const double radius = kBeam * std::tan(angle), away = std::max(3.0, 1.5 * radius), wide = 1.7;
  const glm::dvec3 middle = kLamp + kBeam * kAxis, wall = std::cos(angle) * kAxis + std::sin(angle) * kSide;
  return {{middle + away * kSide, -kSide, 2 * std::atan(1.3 * radius / away)},
          {middle + 0.4 * radius * kSide, kAxis, std::min(3 * angle, wide)},
          {middle, kAxis, std::min(3 * angle, wide)},
          {kLamp + kBeam * wall, wall, std::min(angle, wide)},
          {kLamp + kBeam * wall, wall, wide}};
}

// Along edges and to the corner of a cube of faces, away from the lamp.
std::vector<Eye> eyesAlongEdges() {
  return {{kLamp + glm::dvec3(3, 0.7, 3), {1, 0, 1}, 1},
          {kLamp + glm::dvec3(3, -2, 3), {0, 1, 0}, 1},
          {kLamp + glm::dvec3(-2, 3, 3), {1, 0, 0}, 1.5},
          {kLamp + glm::dvec3(2, 2, 2), {1, 1, 1}, 1.2},
          {kLamp + glm::dvec3(-3, -3, 0.2), {1, 1, 0.2}, 1e-2}};
}

class Rig {
public:
  Rig(const Light& light, const Eye& eye) {
    scene_.distances.assign(25 * 17, kInfinity);
    tests::DepthConvention convention;
    convention.reversed = convention.infinite = true;
    convention.near = 1e-3;
    scene_.setConvention(convention);
    Frame& frame = scene_.frame;
    frame.camera.clipFromView = tests::reversedInfinite(eye.fov, 25.0 / 17, convention.near);
    frame.camera.clipDepth = ClipDepth::ZeroToOne;
    frame.camera.viewFromWorld =
        tests::toMat4(glm::lookAt(eye.position, eye.position + glm::normalize(eye.direction), {0.1, 0.3, 0.9}));
    frame.medium.constituents = {{{0.05F, 0.05F, 0.05F}, Phase::Isotropic, 0}};
    frame.medium.farDistance = 6;
    frame.settings.samples = 64;
    scene_.addLight(light.kind);
    frame.lights[0] = light;
    frame.settings.technique = Technique::Exact;
    unshadowed_ = brightest();
    scene_.setShadow(0, {16, 16, 1, std::vector<float>(16 * 16, 0.0F), {}, {}});
  }

  double unshadowed() const { return unshadowed_; }

  // The brightest of all techniques and filters.
  double leak() {
    double most = 0;
    for (const bool lit : {true, false})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
        for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
          scene_.frame.lights[0].litOutsideViews = lit;
          scene_.frame.settings.shadowFilter = filter;
          scene_.frame.settings.technique = technique;
          const double light = brightest();
          if (!(light <= most)) UNSCOPED_INFO("technique " << static_cast<int>(technique) << ": " << light);
          most = light <= most ? most : light;
        }
    return most;
  }

private:
  double brightest() {
    double most = 0;
    for (const double value : scene_.render().inscatter.rgb)
      most = value <= most ? most : value; // NaN, too
    return most;
  }

  tests::SceneRig scene_{25, 17};
  double unshadowed_ = 0;
};

void checkDark(const Light& light, const std::vector<Eye>& eyes) {
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    CAPTURE(i);
    Rig rig(light, eyes[i]);
    REQUIRE(rig.unshadowed() > 0);
    CHECK(rig.leak() <= 1e-6 * rig.unshadowed());
  }
}

} // namespace

TEST_CASE("a spot whose map is exactly as wide as its cone leaks no light around it", "[sweep]") {
  for (const double degrees : {0.01, 0.1, 0.5, 5.0, 30.0, 80.0})
    for (const bool hard : {true, false})
      for (const bool floats : {false, true}) {
        CAPTURE(degrees, hard, floats);
        const double angle = glm::radians(degrees);
        checkDark(spotAsWideAsItsMap(angle, hard, floats), eyesAround(angle));
      }
}

TEST_CASE("a point light leaks no light along the edges of its cube of faces", "[sweep]") {
  for (const bool floats : {false, true}) {
    CAPTURE(floats);
    checkDark(pointInACube(floats), eyesAlongEdges());
  }
}

TEST_CASE("two views of a sun leak no light along the side that they share", "[sweep]") {
  for (const bool same : {false, true})
    for (const bool floats : {false, true}) {
      CAPTURE(same, floats);
      const Light light = sunThroughTwo(same, floats);
      checkDark(light, {{kLamp, kAxis, 1}, {kLamp, -kAxis, 1e-3}, {kLamp - 3.0 * kAxis, {0.3, 0.2, 1}, 1}});
    }
}

TEST_CASE("a cone wider than its map is lit outside it, or dark, as the light says", "[sweep]") {
  for (const double degrees : {0.1, 5.0, 30.0}) {
    CAPTURE(degrees);
    const double angle = glm::radians(degrees);
    Light light = spotAsWideAsItsMap(angle, true, false);
    light.shadow.views[0].clipFromWorld =
        lookThrough(glm::perspective(2 * 0.98 * angle, 1.0, kNear, 60.0), kLamp, kAxis, false);
    Rig rig(light, eyesAround(angle)[0]);
    CHECK(rig.leak() > 0.02 * rig.unshadowed());
  }
}
