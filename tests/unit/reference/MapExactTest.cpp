#include "TestScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <reference/CameraRays.h>
#include <reference/MapExact.h>
#include <reference/Metrics.h>
#include <reference/Optics.h>

using namespace reference;
using namespace tests;
using tyndall::ShadowFilter;

namespace {

constexpr double kCasterY = 4; ///< height of every caster and pane here

void setDepthAt(MapScene& scene, const Convention& convention, double distanceAlongAxis) {
  const double standard = 0.5 + 0.5 * (100.1 / 99.9 - 20.0 / 99.9 / distanceAlongAxis);
  scene.depth.assign(kWidth * kHeight, convention.depth(standard));
}

/// A sun straight down over |x|, |z| <= half, heights -10 to 10, window depth (10 - y) / 20.
tyndall::ShadowView sunView(double half, int layer, const Convention& convention) {
  const glm::dmat4 look = glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  return {toTyndall(convention.convert() * glm::ortho(-half, half, -half, half, 0.0, 20.0) * look), layer};
}

/// Depth of a caster at kCasterY over x < edge, none elsewhere; x runs with the columns in all views here.
void addHalfPlane(ShadowImage& image, double half, double edge, double casterDepth, const Convention& convention) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double middle = half * (2 * (x + 0.5) / image.width - 1);
      image.depth.push_back(convention.depth(middle < edge ? casterDepth : 1));
    }
}

struct SunScene {
  MapScene scene;
  explicit SunScene(const Convention& convention, int size = 64, double half = 8) : scene(emptyScene(convention)) {
    tyndall::Light sun;
    sun.direction = {0, -3, 0};
    sun.colour = {5, 4, 3};
    sun.shadow.clipDepth = convention.clipDepth;
    sun.shadow.views = {sunView(half, 0, convention)};
    scene.lights = {sun};
    scene.shadows.resize(1);
    scene.shadows[0].width = scene.shadows[0].height = size;
  }
};

/// Radiance of the stretches of [0, end] where light(point) holds, by walking it in steps far finer than the tolerance
/// of its edges and then refining every edge by bisection.
Rgb expected(const MapScene& scene, int x, int y, double end, const std::function<double(glm::dvec3)>& light) {
  const CameraRays rays(scene.camera, scene.width, scene.height);
  const Ray ray = rays.ray(x, y);
  const Airlight airlight(scene.medium, scene.lights[0], ray);
  constexpr int kSteps = 4000;
  const double reach = std::min(end, 60.0);
  Rgb sum{0};
  double begin = 0;
  for (int i = 1; i <= kSteps; ++i) {
    double low = reach * (i - 1) / kSteps, high = reach * i / kSteps;
    const double value = light(ray.at(low));
    if (light(ray.at(high)) != value) {
      const double last = high;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (light(ray.at(middle)) == value ? low : high) = middle;
      }
      sum += value * airlight.span(begin, low);
      begin = low;
      CHECK(light(ray.at(last)) == light(ray.at(high)));
    }
  }
  return sum + light(ray.at(0.5 * (begin + reach))) * airlight.span(begin, end);
}

void checkAll(const MapScene& scene, double end, const std::function<double(glm::dvec3)>& light,
              double tolerance = 1e-7) {
  Image truth(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      truth.set(x, y, expected(scene, x, y, end, light));
  const ErrorMetrics error = compare(mapExact(scene).inscatter, truth);
  INFO(error.text());
  CHECK(error.mean > 0);
  CHECK(error.max <= tolerance);
}

} // namespace

TEST_CASE("map-exact: without maps, with empty and with full ones", "[reference][map]") {
  for (const Convention& convention : kConventions) {
    CAPTURE(static_cast<int>(convention.clipDepth), convention.reversed);
    SunScene sun(convention);
    MapScene& scene = sun.scene;
    setDepthAt(scene, convention, 20);
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      scene.filter = filter;
      scene.shadows[0].depth.assign(64 * 64, convention.depth(1));
      const Image lit = mapExact(scene).inscatter;
      MapScene bare = scene;
      bare.shadows.clear();
      CHECK(compare(lit, mapExact(bare).inscatter).max <= 1e-12);

      const CameraRays rays(scene.camera, kWidth, kHeight);
      const Ray ray = rays.ray(7, 9);
      const double end = rays.distance(7, 9, scene.depth[0]);
      CHECK(end == Approx(20 / glm::dot(ray.direction, glm::normalize(glm::dvec3(-0.2, -0.5, -12)))).epsilon(1e-3));
      CHECK(glm::length(lit.at(7, 9) - integrate(scene.medium, scene.lights[0], ray, 0, end)) < 1e-12);
      CHECK(mapExact(scene).transmittance.at(7, 9).r == Approx(std::exp(-0.05 * end)).epsilon(1e-6));

      // A caster at the near plane darkens all of the view; what lies in no view stays lit or dark as the light says.
      scene.shadows[0].depth.assign(64 * 64, convention.depth(0));
      const auto inView = [](const glm::dvec3& p) { return std::abs(p.x) <= 8 && std::abs(p.z) <= 8 && p.y <= 10; };
      bare = scene;
      bare.depth.assign(bare.depth.size(), convention.depth(1));
      checkAll(bare, kInfinity, [&](const glm::dvec3& p) { return inView(p) ? 0.0 : 1.0; });
      scene.lights[0].litOutsideViews = false;
      const Image dark = mapExact(scene).inscatter;
      CHECK(*std::max_element(dark.rgb.begin(), dark.rgb.end()) == 0);
      scene.lights[0].litOutsideViews = true;
    }
  }
}

TEST_CASE("map-exact: a half plane in the sun, nearest", "[reference][map]") {
  for (const Convention& convention : kConventions) {
    CAPTURE(static_cast<int>(convention.clipDepth), convention.reversed);
    SunScene sun(convention);
    addHalfPlane(sun.scene.shadows[0], 8, 1, (10 - kCasterY) / 20, convention);
    const double casterY = 10 - 20 * (convention.reversed ? 1.0 - sun.scene.shadows[0].depth[0]
                                                          : static_cast<double>(sun.scene.shadows[0].depth[0]));
    for (const bool litOutside : {true, false}) {
      sun.scene.lights[0].litOutsideViews = litOutside;
      checkAll(sun.scene, kInfinity, [&](const glm::dvec3& p) {
        const bool sides = std::abs(p.x) < 8 && std::abs(p.z) < 8;
        if (!sides) return litOutside ? 1.0 : 0.0;
        return p.x >= 1 || p.y >= casterY ? 1.0 : 0.0;
      });
    }
  }
}

TEST_CASE("map-exact: a half plane under a spot and a point light", "[reference][map]") {
  for (const Convention& convention : kConventions) {
    CAPTURE(static_cast<int>(convention.clipDepth), convention.reversed);
    MapScene scene = emptyScene(convention);
    tyndall::Light light;
    light.kind = tyndall::LightKind::Spot;
    light.position = {0, 7, 0};
    light.direction = {0, -1, 0};
    light.colour = {50, 40, 30};
    light.innerConeAngle = 0.3;
    light.outerConeAngle = 0.7;
    light.shadow.clipDepth = convention.clipDepth;
    const glm::dmat4 look = glm::lookAt(glm::dvec3(0, 7, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
    const glm::dmat4 projection = glm::perspective(glm::radians(90.0), 1.0, 0.5, 50.0);
    light.shadow.views = {{toTyndall(convention.convert() * projection * look), 0}};
    ShadowImage image;
    image.width = image.height = 64;
    const glm::dvec4 caster = projection * glm::dvec4(0, 0, -(7 - kCasterY), 1);
    addHalfPlane(image, 1, 0.25, 0.5 + 0.5 * caster.z / caster.w, convention); // x / (7 - y) < 0.25
    const auto lit = [](const glm::dvec3& p) {
      const double below = 7 - p.y;
      return std::abs(p.x) >= below || std::abs(p.z) >= below || p.x / below >= 0.25 || p.y >= kCasterY ? 1.0 : 0.0;
    };
    scene.shadows = {image};
    scene.lights = {light};
    checkAll(scene, kInfinity, lit, 1e-5); // the caster's height is rounded to the float of its depth
    scene.lights[0].kind = tyndall::LightKind::Point;
    scene.lights[0].range = 11;
    checkAll(scene, kInfinity, lit, 1e-5);
  }
}

TEST_CASE("map-exact: six faces of a point light own all directions", "[reference][map]") {
  MapScene scene = emptyScene();
  tyndall::Light light;
  light.kind = tyndall::LightKind::Point;
  light.position = {1, 3, -2};
  light.litOutsideViews = false;
  const glm::dvec3 p = toVec3(light.position);
  const glm::dmat4 projection = glm::perspective(glm::radians(90.0), 1.0, 0.01, 100.0);
  const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ShadowImage image;
  image.width = image.height = 8;
  image.layers = 6;
  image.depth.assign(6 * 64, 1.0F);
  for (int face = 0; face < 6; ++face) {
    const glm::dvec3 up = face == 2 || face == 3 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    light.shadow.views.push_back({toTyndall(projection * glm::lookAt(p, p + axes[face], up)), face});
  }
  scene.lights = {light};
  scene.shadows = {image};
  checkAll(scene, kInfinity, [](const glm::dvec3&) { return 1.0; });
  // The face towards -y dark: that pyramid, all but its first hundredth, is in shadow.
  std::fill(scene.shadows[0].depth.begin() + 3 * 64, scene.shadows[0].depth.begin() + 4 * 64, 0.0F);
  checkAll(scene, kInfinity, [&](const glm::dvec3& x) {
    const glm::dvec3 d = x - p;
    return -d.y > std::max({0.01, std::abs(d.x), std::abs(d.z)}) ? 0.0 : 1.0;
  });
}

TEST_CASE("map-exact: bilinear filtering is a ramp between texel centres", "[reference][map]") {
  const Convention convention;
  SunScene sun(convention, 160, 40); // texels of 0.5, and all rays stay inside
  MapScene& scene = sun.scene;
  scene.filter = ShadowFilter::Bilinear;
  addHalfPlane(scene.shadows[0], 40, 0.5, 0.05, convention); // caster at y = 9; the ramp runs from x = 0.25 to 0.75
  setDepthAt(scene, convention, 15);
  const CameraRays rays(scene.camera, kWidth, kHeight);
  Image truth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const Ray ray = rays.ray(x, y);
      const Airlight airlight(scene.medium, scene.lights[0], ray);
      const double end = rays.distance(x, y, scene.depth[0]);
      Rgb sum{0};
      constexpr int kSteps = 4000;
      for (int i = 0; i < kSteps; ++i) {
        const double a = end * i / kSteps, b = end * (i + 1) / kSteps;
        sum += std::clamp((ray.at(0.5 * (a + b)).x - 0.25) / 0.5, 0.0, 1.0) * airlight.span(a, b);
      }
      truth.set(x, y, sum);
    }
  const ErrorMetrics error = compare(mapExact(scene).inscatter, truth);
  INFO(error.text());
  CHECK(error.max < 1e-6); // of the midpoint rule
}

TEST_CASE("map-exact: bilinear tends to nearest as the map grows", "[reference][map]") {
  const Convention convention;
  double last = kInfinity;
  for (const int size : {32, 128, 512}) {
    SunScene sun(convention, size);
    addHalfPlane(sun.scene.shadows[0], 8, 1, 0.3, convention);
    const Image nearest = mapExact(sun.scene).inscatter;
    sun.scene.filter = ShadowFilter::Bilinear;
    const double error = compare(mapExact(sun.scene).inscatter, nearest).rRmse;
    CHECK(error < last / 3);
    last = error;
  }
}

TEST_CASE("map-exact: two cascades that agree equal one view", "[reference][map]") {
  for (const Convention& convention : kConventions) {
    SunScene one(convention), two(convention);
    const double depth = (10 - kCasterY) / 20;
    addHalfPlane(one.scene.shadows[0], 8, 1, depth, convention);
    two.scene.lights[0].shadow.views = {sunView(2, 0, convention), sunView(8, 1, convention)};
    two.scene.shadows[0].layers = 2;
    addHalfPlane(two.scene.shadows[0], 2, 1, depth, convention);
    addHalfPlane(two.scene.shadows[0], 8, 1, depth, convention);
    CHECK(compare(mapExact(two.scene).inscatter, mapExact(one.scene).inscatter).max < 1e-12);
    // The first cascade owns its points: darken it alone.
    std::fill_n(two.scene.shadows[0].depth.begin(), 64 * 64, convention.depth(0));
    CHECK(compare(mapExact(two.scene).inscatter, mapExact(one.scene).inscatter).rRmse > 0.05);
  }
}

TEST_CASE("map-exact: beyond the far plane a cascade hands over, the last one judges", "[reference][map]") {
  const Convention convention;
  MapScene scene = SunScene(convention).scene;
  const glm::dmat4 look = glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  const tyndall::ShadowView shallow = {toTyndall(glm::ortho(-8.0, 8.0, -8.0, 8.0, 0.0, 8.0) * look), 0}; // to y = 2
  scene.shadows[0].layers = 2;
  scene.shadows[0].depth.assign(64 * 64, 0.0F);
  scene.shadows[0].depth.resize(2 * 64 * 64, 1.0F);
  const auto sides = [](const glm::dvec3& p) { return std::abs(p.x) < 8 && std::abs(p.z) < 8; };
  scene.lights[0].shadow.views = {shallow, sunView(8, 1, convention)};
  checkAll(scene, kInfinity, [&](const glm::dvec3& p) { return sides(p) && p.y > 2 && p.y < 10 ? 0.0 : 1.0; });
  scene.lights[0].shadow.views = {shallow};
  checkAll(scene, kInfinity, [&](const glm::dvec3& p) { return sides(p) && p.y < 10 ? 0.0 : 1.0; });
}

TEST_CASE("map-exact: glass tints what lies behind it", "[reference][map]") {
  for (const Convention& convention : kConventions) {
    SunScene sun(convention);
    MapScene& scene = sun.scene;
    scene.medium.constituents[0].scattering = {0.1F, 0.1F, 0.1F};
    scene.shadows[0].depth.assign(64 * 64, convention.depth(1));
    scene.shadows[0].glassDepth.assign(64 * 64, convention.depth((10 - kCasterY) / 20));
    for (int i = 0; i < 64 * 64; ++i)
      for (const float channel : {0.5F, 0.5F, 0.5F})
        scene.shadows[0].glassColour.push_back(channel);
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      scene.filter = filter;
      checkAll(
          scene, kInfinity,
          [](const glm::dvec3& p) { return std::abs(p.x) < 8 && std::abs(p.z) < 8 && p.y < kCasterY ? 0.5 : 1.0; },
          1e-6); // the pane's height is rounded to the float of its depth
    }
  }
}

TEST_CASE("map-exact: sky, NaN, several samples and single pixels", "[reference][map]") {
  SunScene sun({});
  MapScene& scene = sun.scene;
  addHalfPlane(scene.shadows[0], 8, 1, 0.3, {});
  scene.medium.farDistance = 13;
  const ImageAnswer all = mapExact(scene);
  CHECK(all.transmittance.at(0, 0).g == Approx(std::exp(-0.08 * 13)).epsilon(1e-6));
  const std::vector<PixelAnswer> some = mapExact(scene, {{3, 4}, {20, 1}});
  CHECK(some[0].inscatter == all.inscatter.at(3, 4));
  CHECK(some[1].inscatter == all.inscatter.at(20, 1));

  MapScene near = scene;
  setDepthAt(near, {}, 3);
  const Image nearAnswer = mapExact(near).inscatter;
  MapScene both = scene;
  both.samples = 2;
  both.depth.clear();
  for (std::size_t i = 0; i < scene.depth.size(); ++i)
    both.depth.insert(both.depth.end(), {scene.depth[i], near.depth[i]});
  CHECK(mapExact(both).inscatter.at(9, 9).b ==
        Approx(0.5 * (all.inscatter.at(9, 9).b + nearAnswer.at(9, 9).b)).epsilon(1e-12));

  scene.depth[5] = std::nanf("");
  CHECK(mapExact(scene).inscatter.at(5, 0) == Rgb(0));
  CHECK(mapExact(scene).transmittance.at(5, 0) == Rgb(1));
  scene.depth.pop_back();
  CHECK_THROWS_AS(mapExact(scene), std::invalid_argument);
}
