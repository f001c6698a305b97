#include "gl/ReadBack.h"
#include "gl/SceneRenderer.h"
#include "gl/host/SmallScenes.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

using host::ClipConvention;
using tests::addMaterial;
using tests::addQuad;
using tests::addWall;
using tests::restPose;

namespace {

constexpr int kSide = 32;
constexpr std::size_t kMiddle = kSide / 2 * kSide + kSide / 2;
const double kPi = glm::pi<double>();

struct Picture {
  std::vector<float> rgb;
  glm::vec3 at(std::size_t pixel) const { return {rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]}; }
};

/// Renders through an orthographic camera that looks along -z and shows x and y in [-2, 2].
Picture render(host::SceneRenderer& renderer, const host::Scene& scene, const std::vector<tyndall::Light>& lights,
               const tyndall::Medium* medium = nullptr) {
  host::RenderTargets targets({kSide, kSide, GL_RGBA32F});
  const tyndall::Camera camera = tests::cameraAtOrigin(host::orthographic(2, 2, -20, 20, {}));
  renderer.renderScene(restPose(scene), camera, lights, targets, scene.skyRadiance, medium);
  return {host::readColour(targets.colour(), kSide, kSide, 3)};
}

Picture render(const host::Scene& scene, const std::vector<tyndall::Light>& lights,
               const tyndall::Medium* medium = nullptr) {
  host::SceneRenderer renderer(scene);
  return render(renderer, scene, lights, medium);
}

void checkRgb(const glm::vec3& actual, const glm::dvec3& expected, double tolerance = 1e-5) {
  for (int channel = 0; channel < 3; ++channel) {
    CHECK(actual[channel] == Approx(expected[channel]).epsilon(tolerance).margin(1e-9));
  }
}

tyndall::Light sun(const tyndall::Vec3& direction, const tyndall::Rgb& irradiance) {
  tyndall::Light light;
  light.direction = direction;
  light.colour = irradiance;
  return light;
}

/// A light one above the middle of the wall at z = 0, off to the side.
tyndall::Light pointLight() {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Point;
  light.position = {0.0625, 0.0625, 2}; // above the middle of a pixel
  light.colour = {4, 8, 12};
  return light;
}

} // namespace

TEST_CASE("a Lambert surface reflects albedo / pi of its irradiance", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.materials[0].baseColour = {0.5F, 0.25F, 1, 1};
  addWall(scene, 0, 2);
  const double cosine = 3.0 / 5;
  checkRgb(render(scene, {sun({8, 0, -6}, {1, 2, 3})}).at(kMiddle),
           cosine / kPi * glm::dvec3(0.5 * 1, 0.25 * 2, 1 * 3));
  checkRgb(render(scene, {sun({0, 0, -1}, {1, 1, 1}), sun({0, 0, -7}, {1, 1, 1})}).at(kMiddle),
           2 / kPi * glm::dvec3(0.5, 0.25, 1));
  checkRgb(render(scene, {sun({0, 0, 1}, {1, 1, 1})}).at(kMiddle), glm::dvec3(0));
}

TEST_CASE("surfaces have two sides", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addQuad(scene, {0, 0, 0}, {-2, 0, 0}, {0, 2, 0}); // faces -z, away from the camera
  checkRgb(render(scene, {sun({0, 0, -1}, {1, 1, 1})}).at(kMiddle), glm::dvec3(1 / kPi));
  checkRgb(render(scene, {sun({0, 0, 1}, {1, 1, 1})}).at(kMiddle), glm::dvec3(0));
}

TEST_CASE("light fades out evenly where the face turns away and the shading normal does not", "[surface]") {
  tests::testContext();
  const glm::vec3 normal(0.6F, 0, 0.8F);
  host::Scene scene = tests::emptyScene();
  addWall(scene, 0, 2);
  for (host::Vertex& vertex : scene.meshes[0].primitives[0].vertices)
    vertex.normal = normal;
  const auto radianceAt =
      [&](double degrees) { // of the light from the face's normal, to the side of the shading normal
        const glm::dvec3 toLight(std::sin(glm::radians(degrees)), 0, std::cos(glm::radians(degrees)));
        return render(scene, {sun({-toLight.x, -toLight.y, -toLight.z}, {1, 1, 1})}).at(kMiddle).r * kPi;
      };
  CHECK(radianceAt(0) ==
        Approx(0.8).epsilon(1e-5)); // as Lambert has it: the face sees the light better than the normal
  double last = radianceAt(60);
  for (double degrees = 62; degrees < 90; degrees += 2) {
    const double radiance = radianceAt(degrees);
    CHECK(radiance < last);
    CHECK(radiance > last - 0.06);
    last = radiance;
  }
  CHECK(radianceAt(89.9) < 0.003);
  CHECK(radianceAt(90.1) == 0);
}

TEST_CASE("base colour textures are sRGB", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.textures.push_back({1, 1, {188, 255, 0, 255}});
  scene.materials[0].texture = 0;
  addWall(scene, 0, 2);
  const double linear = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  checkRgb(render(scene, {sun({0, 0, -1}, {1, 1, 1})}).at(kMiddle), glm::dvec3(linear, 1, 0) / kPi, 2e-3);
}

TEST_CASE("colours of vertices tint the base colour, linearly", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.materials[0].baseColour = {0.5F, 1, 1, 1};
  addWall(scene, 0, 2);
  for (host::Primitive& primitive : scene.meshes.back().primitives)
    for (host::Vertex& vertex : primitive.vertices)
      vertex.colour = {65535, vertex.position.x < 0 ? 0 : 65535, 13107, 0};
  const Picture picture = render(scene, {sun({0, 0, -1}, {1, 1, 1})});
  checkRgb(picture.at(kMiddle), glm::dvec3(0.5, 0.5 + 0.5 / kSide, 0.2) / kPi, 2e-3);
}

TEST_CASE("point and spot lights fall off as glTF says", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, 0, 2);
  tyndall::Light light = pointLight();
  const glm::dvec3 intensity(4, 8, 12);
  checkRgb(render(scene, {light}).at(kMiddle), intensity / (4 * kPi));

  tyndall::Medium medium;
  medium.absorption = {0.1F, 0, 0};
  medium.constituents.push_back({{0, 0.2F, 0.3F}});
  checkRgb(render(scene, {light}, &medium).at(kMiddle),
           intensity / (4 * kPi) * glm::exp(-2.0 * glm::dvec3(0.1, 0.2, 0.3)));

  light.range = 1.9;
  checkRgb(render(scene, {light}).at(kMiddle), glm::dvec3(0));

  light.range = 10;
  light.kind = tyndall::LightKind::Spot;
  light.innerConeAngle = 0.2;
  light.outerConeAngle = 0.6;
  const double angle = 0.4;
  light.direction = {std::sin(angle), 0, -std::cos(angle)};
  const double falloff = std::pow((std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6)), 2);
  checkRgb(render(scene, {light}).at(kMiddle), falloff / (4 * kPi) * intensity, 1e-4);
  light.outerConeAngle = 0.39;
  checkRgb(render(scene, {light}).at(kMiddle), glm::dvec3(0));
}

TEST_CASE("emission and ambient light reach shadowed surfaces", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.materials[0].emission = {1, 2, 3};
  addWall(scene, 0, 2);
  checkRgb(render(scene, {}).at(kMiddle), {1, 2, 3});
  scene.materials[0].emission = {0, 0, 0};
  scene.skyRadiance = {1, 1, 1};
  const float ambient = render(scene, {}).at(kMiddle).r;
  CHECK(ambient > 0.05F);
  CHECK(ambient < 0.5F);
}

TEST_CASE("glass and blended surfaces change what is behind them", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.materials[0].emission = {1, 1, 1};
  addWall(scene, 0, 2);
  host::Material blended;
  blended.alphaMode = host::AlphaMode::Blend;
  blended.baseColour = {0, 0, 0, 0.25F};
  blended.emission = {0, 2, 0};
  addWall(scene, 2, 2, addMaterial(scene, blended));
  host::Material glass;
  glass.baseColour = {1, 0.5F, 0, 1};
  glass.transmission = 0.5F;
  addWall(scene, 1, 2, addMaterial(scene, glass));
  // Behind: 1; through the glass: (0.5, 0.25, 0); a quarter covered by (0, 2, 0).
  checkRgb(render(scene, {}).at(kMiddle), {0.375, 0.6875, 0});
}

TEST_CASE("a flat surface at any slope is free of acne, and what is behind a caster is dark", "[surface]") {
  tests::testContext();
  constexpr int kShadowSize = 64;
  for (const ClipConvention convention : {ClipConvention{false}, ClipConvention{true}}) {
    for (const double degrees : {0.0, 10.0, 45.0, 70.0, 85.0, 88.0}) {
      INFO(degrees << " degrees, " << tests::nameOf(convention));
      const double angle = glm::radians(degrees);
      host::Scene scene = tests::emptyScene();
      addWall(scene, 0, 50);
      const glm::dvec3 direction(std::sin(angle), 0.1 * std::sin(angle), -std::cos(angle));
      tyndall::Light light = sun({direction.x, direction.y, direction.z}, {1, 1, 1});
      const glm::dmat4 viewFromWorld = host::viewLooking(-20.0 * direction, direction, {0.3, 1, 0});
      light.shadow.views = {{host::toMat4(host::orthographic(4, 4, 1, 120, convention) * viewFromWorld), 0}};
      host::SceneRenderer renderer(scene);
      const std::vector<float> unshadowed = render(renderer, scene, {light}).rgb;
      const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, kShadowSize);
      maps.attachTo(light);
      CHECK(render(renderer, scene, {light}).rgb == unshadowed);

      const glm::vec3 across = glm::normalize(glm::cross(direction, glm::dvec3(0, 1, 0)));
      addQuad(scene, -8.0 * direction, 4.0F * across, 4.0F * glm::cross(across, glm::vec3(direction)));
      host::SceneRenderer withCaster(scene);
      const host::ShadowMapTextures darkened = withCaster.renderShadowMap(restPose(scene), light, kShadowSize);
      darkened.attachTo(light);
      if (degrees > 60) { // else the camera sees the caster
        const std::vector<float> dark = render(withCaster, scene, {light}).rgb;
        CHECK(*std::max_element(dark.begin(), dark.end()) == 0.0F);
      }
    }
  }
}

TEST_CASE("a point light's shadows are free of acne on the walls of its room", "[surface]") {
  tests::testContext();
  constexpr double kFar = 20;
  host::Scene scene = tests::emptyScene();
  addWall(scene, 0, 10);
  tyndall::Light light = pointLight();
  light.position = {1.2, -0.7, 0.4};
  const glm::dvec3 eye(light.position[0], light.position[1], light.position[2]);
  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    light.shadow.views.push_back(
        {host::toMat4(host::perspective(1, 1, 0.01, kFar, {}) * host::viewLooking(eye, axes[face])), face});
  }
  host::SceneRenderer renderer(scene);
  const std::vector<float> unshadowed = render(renderer, scene, {light}).rgb;
  const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, 64);
  maps.attachTo(light);
  const std::vector<float> shadowed = render(renderer, scene, {light}).rgb;
  CHECK(*std::min_element(unshadowed.begin(), unshadowed.end()) > 0.0F);
  CHECK(shadowed == unshadowed);
}

TEST_CASE("shadows are where the geometry puts them, tinted by glass", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  host::Material glass;
  glass.baseColour = {1, 0.5F, 0.25F, 1};
  glass.transmission = 1;
  addWall(scene, 0, 2);
  const int pane = addMaterial(scene, glass);
  // The sun shines at 45 degrees: a caster at height 10 lies 10 to the right of its shadow, out of the picture.
  addWall(scene, 10, 1, 0, {9, 1});      // the shadow: x in [-2, 0], y in [0, 2]
  addWall(scene, 10, 1, pane, {11, -1}); // the tint: x in [0, 2], y in [-2, 0]
  for (const host::ShadowTarget target : {host::ShadowTarget::Array, host::ShadowTarget::Single}) {
    tyndall::Light light = sun({-1, 0, -1}, {1, 1, 1});
    const glm::dmat4 viewFromWorld = host::viewLooking({20, 0, 20}, {-1, 0, -1});
    light.shadow.views = {{host::toMat4(host::orthographic(3, 3, 1, 60, {}) * viewFromWorld), 0}};
    host::SceneRenderer renderer(scene);
    const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, 512, target);
    maps.attachTo(light);
    const Picture picture = render(renderer, scene, {light});
    const double lit = std::sqrt(0.5) / kPi;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool right = x >= kSide / 2;
        const bool up = y >= kSide / 2;
        const bool nearEdge = std::abs(2 * x + 1 - kSide) < 4 || std::abs(2 * y + 1 - kSide) < 4 || x == 0 || y == 0 ||
                              x == kSide - 1 || y == kSide - 1;
        if (nearEdge) {
          continue;
        }
        const glm::dvec3 tint = !right && up ? glm::dvec3(0) : right && !up ? glm::dvec3(1, 0.5, 0.25) : glm::dvec3(1);
        checkRgb(picture.at(static_cast<std::size_t>(y) * kSide + x), lit * tint);
      }
    }
  }
}

TEST_CASE("outside its shadow views a light is lit or dark as it says", "[surface]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, 0, 2);
  host::SceneRenderer renderer(scene);
  tyndall::Light light = tests::sunAlongZ(1, 5, -5);
  const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, 64);
  maps.attachTo(light);
  CHECK(render(renderer, scene, {light}).at(0).r == Approx(1 / kPi));
  light.litOutsideViews = false;
  const Picture picture = render(renderer, scene, {light});
  CHECK(picture.at(0).r == 0.0F);
  CHECK(picture.at(kMiddle).r == Approx(1 / kPi));
}
