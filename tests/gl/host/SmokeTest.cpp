// Smoke against its closed form: captured, on surfaces behind it, and in the picture.
#include "gl/ReadBack.h"
#include "gl/SceneRenderer.h"
#include "gl/avsm/AvsmRig.h"
#include "gl/host/SmallScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

using host::SmokeParticle;
using tests::addWall;
using tests::AvsmRig;
using tests::restPose;

namespace {

constexpr int kSide = 33; // odd: the middle of a pixel and of a texel is on the axis
constexpr std::size_t kMiddle = kSide / 2 * kSide + kSide / 2;

/// Optical depth of a whole line that passes a particle's middle at a distance.
double opticalDepth(const SmokeParticle& particle, double aside) {
  const double r = particle.radius;
  const double h = std::sqrt(std::max(0.0, r * r - aside * aside));
  return particle.density * 16 / 15 * std::pow(h, 5) / std::pow(r, 4);
}

SmokeParticle ball(const glm::dvec3& position, double radius, double density) {
  return {position, radius, density, {0.8F, 0.5F, 0.25F}};
}

tyndall::AvsmConfig configOf(int size) {
  tyndall::AvsmConfig config;
  config.size = size;
  config.packed = false;
  return config;
}

void capture(AvsmRig& rig, host::SceneRenderer& renderer, const tyndall::Light& light, int size) {
  REQUIRE(rig.avsm().begin());
  renderer.captureVolumes(light, size);
  REQUIRE(rig.avsm().resolve());
}

/// The middle pixel of what a camera sees, without a sky.
glm::vec3 middlePixel(host::SceneRenderer& renderer, const host::Scene& scene, const tyndall::Camera& camera,
                      const std::vector<tyndall::Light>& lights, int samples = 1) {
  host::RenderTargetOptions options{kSide, kSide, GL_RGBA32F};
  options.samples = samples;
  host::RenderTargets targets(options);
  renderer.renderScene(restPose(scene), camera, lights, targets, glm::vec3(0));
  const std::vector<float> rgb = host::readColour(targets.colour(), kSide, kSide, 3);
  return {rgb[3 * kMiddle], rgb[3 * kMiddle + 1], rgb[3 * kMiddle + 2]};
}

host::Scene glowingWall(double z) {
  host::Scene scene = tests::emptyScene();
  scene.materials[0].emission = {1, 1, 1};
  scene.materials[0].baseColour = {0, 0, 0, 1};
  addWall(scene, z, 100);
  return scene;
}

void checkRgb(const glm::vec3& actual, const glm::dvec3& expected, double tolerance = 2e-4) {
  for (int channel = 0; channel < 3; ++channel)
    CHECK(actual[channel] == Approx(expected[channel]).epsilon(tolerance).margin(1e-6));
}

} // namespace

TEST_CASE("a captured ball of smoke dims every line by its closed form", "[smoke]") {
  if (!tests::hasAvsm()) return;
  const host::Scene scene = tests::emptyScene();
  const SmokeParticle particle = ball({0.3, -0.2, -5}, 1.5, 0.8);
  for (const host::ClipConvention& convention : tests::allConventions()) {
    if (!tests::supports(convention)) continue;
    for (const bool spot : {false, true}) {
      INFO((spot ? "spot, " : "directional, ") << tests::nameOf(convention));
      const tyndall::Light light =
          spot ? tests::spotAtOrigin(1, 10, convention) : tests::sunAlongZ(3, 0, -10, convention);
      host::SceneRenderer renderer(scene);
      renderer.setVolumes({particle}, {});
      AvsmRig rig(configOf(kSide));
      capture(rig, renderer, light, kSide);
      double worst = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const glm::dvec2 ndc = (2.0 * glm::dvec2(x, y) + 1.0) / static_cast<double>(kSide) - 1.0;
          const glm::dvec3 onLine = spot ? glm::dvec3(0) : glm::dvec3(3.0 * ndc, 0);
          const glm::dvec3 direction = spot ? glm::normalize(glm::dvec3(ndc, -1)) : glm::dvec3(0, 0, -1);
          const double aside = glm::length(glm::cross(particle.position - onLine, direction));
          const double depth = opticalDepth(particle, aside);
          const double expected = depth < 1e-4 ? 1 : std::exp(-depth);
          worst = std::max(worst, std::abs(tests::curveAt(rig.curve({x, y, 0}), 1) - expected));
        }
      CHECK(worst < 2e-6);
      const tests::Curve middle = rig.curve({kSide / 2, kSide / 2, 0});
      const double nearPlane = spot ? 1 : 0;
      const double depth = (5 - nearPlane) / (10 - nearPlane); // of the ball's middle
      CHECK(tests::curveAt(middle, depth - 1.6 / (10 - nearPlane)) == 1);
      const double whole = tests::curveAt(middle, 1);
      CHECK(tests::curveAt(middle, depth) == Approx(std::sqrt(whole)).margin(0.02));
    }
  }
}

TEST_CASE("each shadow view captures into a layer of its own", "[smoke]") {
  if (!tests::hasAvsm()) return;
  const host::Scene scene = tests::emptyScene();
  const SmokeParticle particle = ball({0, 0, -5}, 1, 1);
  tyndall::Light light = tests::sunAlongZ(3, 0, -10);
  light.shadow.views.push_back(tests::sunAlongZ(3, -7, -10).shadow.views[0]); // begins behind the ball
  light.shadow.views.back().layer = 1;
  host::SceneRenderer renderer(scene);
  renderer.setVolumes({particle}, {});
  tyndall::AvsmConfig config = configOf(kSide);
  config.layers = 2;
  AvsmRig rig(config);
  capture(rig, renderer, light, kSide);
  const double expected = std::exp(-opticalDepth(particle, 0));
  CHECK(tests::curveAt(rig.curve({kSide / 2, kSide / 2, 0}), 0.1) == 1);
  CHECK(tests::curveAt(rig.curve({kSide / 2, kSide / 2, 0}), 1) == Approx(expected).epsilon(1e-4));
  CHECK(tests::curveAt(rig.curve({kSide / 2, kSide / 2, 1}), 0.01) == Approx(expected).epsilon(1e-4));
}

TEST_CASE("surfaces behind smoke are dimmed by it, those before it are not", "[smoke]") {
  if (!tests::hasAvsm()) return;
  host::Scene scene = tests::emptyScene();
  addWall(scene, -8, 4);
  host::Scene before = tests::emptyScene();
  addWall(before, -2, 4);
  const SmokeParticle particle = ball({0, 0, -5}, 2.5, 0.5);
  for (const bool spot : {false, true}) {
    tyndall::Light light = spot ? tests::spotAtOrigin(1, 10) : tests::sunAlongZ(4, 0, -10);
    light.colour = {1, 2, 3};
    light.outerConeAngle = 1;
    const auto radiance = [&](const host::Scene& shown, bool dimmed) {
      host::SceneRenderer renderer(shown);
      const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(shown), light, 64);
      maps.attachTo(light);
      renderer.setVolumes({particle}, {});
      AvsmRig rig(configOf(65));
      capture(rig, renderer, light, 65);
      renderer.setVolumes({}, {}); // so that the camera does not look through it
      light.curves = dimmed ? rig.avsm().curves() : tyndall::AvsmCurves{};
      const tyndall::Camera camera = tests::cameraAtOrigin(host::orthographic(1, 1, 0.1, 20, {}));
      return middlePixel(renderer, shown, camera, {light});
    };
    const double expected = std::exp(-opticalDepth(particle, 0));
    checkRgb(radiance(scene, true), expected * glm::dvec3(radiance(scene, false)), 5e-3);
    checkRgb(radiance(before, true), glm::dvec3(radiance(before, false)));
  }
}

TEST_CASE("smoke dims what the camera sees behind it and ends where a surface does", "[smoke]") {
  tests::testContext();
  const SmokeParticle particle = ball({0, 0, -5}, 2, 0.6);
  const double whole = opticalDepth(particle, 0);
  for (const host::ClipConvention& convention : tests::allConventions()) {
    if (!tests::supports(convention)) continue;
    INFO(tests::nameOf(convention));
    const auto seen = [&](double wall, const SmokeParticle& smoke, const glm::dmat4& clipFromView) {
      const host::Scene scene = glowingWall(wall);
      host::SceneRenderer renderer(scene);
      renderer.setVolumes({smoke}, {});
      return middlePixel(renderer, scene, tests::cameraAtOrigin(clipFromView, convention.clipDepth), {});
    };
    const double infinity = std::numeric_limits<double>::infinity();
    for (const glm::dmat4& clipFromView :
         {host::perspective(0.5, 0.5, 0.1, 30, convention), host::perspective(0.5, 0.5, 0.1, infinity, convention),
          host::orthographic(2, 2, 0.1, 30, convention)}) {
      checkRgb(seen(-9, particle, clipFromView), glm::dvec3(std::exp(-whole)));
      checkRgb(seen(-5, particle, clipFromView), glm::dvec3(std::exp(-0.5 * whole)), 1e-3);
      checkRgb(seen(-2, particle, clipFromView), glm::dvec3(1));
    }
    // The eye in the middle of a ball, and one behind it.
    const glm::dmat4 perspective = host::perspective(0.5, 0.5, 0.1, 30, convention);
    checkRgb(seen(-9, ball({0, 0, 0}, 2, 0.6), perspective), glm::dvec3(std::exp(-0.5 * whole)));
    checkRgb(seen(-9, ball({0, 0, 2.5}, 2, 0.6), perspective), glm::dvec3(1));
  }
}

TEST_CASE("smoke scatters light evenly, in its own colour", "[smoke]") {
  tests::testContext();
  const host::Scene scene = tests::emptyScene();
  const SmokeParticle particle = ball({0, 0, -5}, 2, 0.6);
  host::SceneRenderer renderer(scene);
  renderer.setVolumes({particle}, {});
  tyndall::Light sun;
  sun.direction = {1, -2, 0.5};
  sun.colour = {3, 2, 1};
  const tyndall::Camera camera = tests::cameraAtOrigin(host::perspective(0.5, 0.5, 0.1, 30, {}));
  const double stopped = 1 - std::exp(-opticalDepth(particle, 0));
  const glm::dvec3 expected = stopped / (4 * glm::pi<double>()) * glm::dvec3(particle.albedo) * glm::dvec3(3, 2, 1);
  checkRgb(middlePixel(renderer, scene, camera, {sun}), expected);
  checkRgb(middlePixel(renderer, scene, camera, {sun, sun}), 2.0 * expected);
  checkRgb(middlePixel(renderer, scene, camera, {sun}, 4), expected);

  tyndall::Light point;
  point.kind = tyndall::LightKind::Point;
  point.position = {0, 40, -5}; // so far off that all of the ball is lit alike
  point.colour = {1600 * 3, 1600 * 2, 1600};
  checkRgb(middlePixel(renderer, scene, camera, {point}), expected, 2e-2);
}

TEST_CASE("smoke lies in the shadow of surfaces and of smoke before it", "[smoke]") {
  if (!tests::hasAvsm()) return;
  const SmokeParticle near = ball({0, 0, -3}, 1.5, 0.7), far = ball({0, 0, -8}, 0.4, 3);
  tyndall::Light light = tests::sunAlongZ(4, 0, -10);
  const auto radiance = [&](const host::Scene& scene, std::vector<SmokeParticle> blockers) {
    host::SceneRenderer renderer(scene);
    const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, 64);
    maps.attachTo(light);
    AvsmRig rig(configOf(65));
    blockers.push_back(ball({3, 3, -5}, 0.2, 1)); // elsewhere, so that there are curves
    renderer.setVolumes(std::move(blockers), {});
    capture(rig, renderer, light, 65);
    light.curves = rig.avsm().curves();
    renderer.setVolumes({far}, {});
    tyndall::Camera camera = tests::cameraAtOrigin(host::perspective(0.2, 0.2, 0.1, 30, {}));
    camera.viewFromWorld = host::toMat4(host::viewLooking({0, -5, -8}, {0, 1, 0}, {0, 0, 1}));
    return middlePixel(renderer, scene, camera, {light}).r;
  };
  const host::Scene empty = tests::emptyScene();
  const float lit = radiance(empty, {});
  CHECK(lit > 0.01F);
  CHECK(radiance(empty, {near}) == Approx(lit * std::exp(-opticalDepth(near, 0))).epsilon(0.03));
  host::Scene walled = tests::emptyScene();
  addWall(walled, -1, 2);
  CHECK(radiance(walled, {}) == 0.0F);
}
