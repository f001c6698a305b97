// Technique exact against the map-exact reference, on made-up shadow maps that have every kind of edge.
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

using namespace tyndall;

namespace {

constexpr int kWidth = 48, kHeight = 32;

float uniform(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24F; }

// Blocks, slopes and specks between near and far; a third of the texels hold no caster.
std::vector<float> casterDepths(int size, int layers, bool reversed, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> depth;
  for (int layer = 0; layer < layers; ++layer) {
    std::vector<float> field(static_cast<std::size_t>(size * size), 1.0F);
    for (int block = 0; block < 40; ++block) {
      const int x0 = static_cast<int>(uniform(random) * static_cast<float>(size)),
                y0 = static_cast<int>(uniform(random) * static_cast<float>(size));
      const int extent = 1 + static_cast<int>(uniform(random) * static_cast<float>(size) / 6);
      const float base = 0.1F + 0.8F * uniform(random),
                  slope = 0.2F * (uniform(random) - 0.5F) / static_cast<float>(extent);
      for (int y = y0; y < std::min(size, y0 + extent); ++y)
        for (int x = x0; x < std::min(size, x0 + extent); ++x)
          field[static_cast<std::size_t>(y * size + x)] = std::min(0.99F, base + slope * static_cast<float>(x - x0));
    }
    for (float d : field)
      depth.push_back(reversed ? 1 - d : d);
  }
  return depth;
}

std::vector<float> tints(std::size_t texels, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> rgb(3 * texels);
  for (float& c : rgb)
    c = uniform(random);
  return rgb;
}

// A wall of varying distance behind the scene, some sky.
std::vector<float> sceneDepth(double near) {
  std::vector<float> depth;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth.push_back((x / 8 + y / 8) % 5 == 0 ? 0 : static_cast<float>(near / (3 + 0.2 * x + 0.1 * (y % 7))));
  return depth;
}

glm::dmat4 zeroToOneFromSymmetric() {
  glm::dmat4 m(1);
  m[2][2] = m[3][2] = 0.5;
  return m;
}

glm::dmat4 reverse() {
  glm::dmat4 m(1); // z in [0, 1] to 1 - z
  m[2][2] = -1;
  m[3][2] = 1;
  return m;
}

struct Setup {
  LightKind kind = LightKind::Directional;
  int views = 1;
  bool array = true;
  bool reversed = false;
  ClipDepth clipDepth = ClipDepth::NegativeOneToOne;
  ShadowFilter filter = ShadowFilter::Nearest;
  bool glass = false;
  bool monochrome = false;
  bool litOutside = true;
  double fade = 0;
  int size = 64;
};

// Views around the volume in front of the camera (which looks from (0, 1, 6) towards the origin).
std::vector<ShadowView> viewsOf(const Setup& setup, const Light& light) {
  std::vector<ShadowView> views;
  const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
  const glm::dvec3 direction(light.direction[0], light.direction[1], light.direction[2]);
  const glm::dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < setup.views; ++i) {
    glm::dmat4 clip;
    if (setup.kind == LightKind::Directional) {
      const double extent = 2.5 * (i + 1); // cascades around one another
      clip = glm::ortho(-extent, extent, -extent, extent, 1.0, 8.0 + 4 * i) *
             glm::lookAt(-5.0 * glm::normalize(direction), glm::dvec3(0.1 * i, 0, 0), glm::dvec3(0, 0, 1));
    } else if (setup.kind == LightKind::Spot) {
      clip = glm::perspective(2 * light.outerConeAngle + 0.01, 1.0, 0.3, 12.0) *
             glm::lookAt(position, position + direction, glm::dvec3(0, 0, 1));
    } else {
      const glm::dvec3 up = std::abs(axes[i].y) > 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
      clip = glm::perspective(glm::radians(90.0), 1.0, 0.2, 12.0) * glm::lookAt(position, position + axes[i], up);
    }
    if (setup.clipDepth == ClipDepth::ZeroToOne || setup.reversed) clip = zeroToOneFromSymmetric() * clip;
    if (setup.reversed) clip = reverse() * clip;
    if (setup.clipDepth == ClipDepth::NegativeOneToOne && setup.reversed)
      clip = glm::inverse(zeroToOneFromSymmetric()) * clip;
    views.push_back({tests::toMat4(clip), setup.array ? i : 0});
  }
  return views;
}

Light lightOf(const Setup& setup) {
  Light light;
  light.kind = setup.kind;
  light.direction = {0.4, -1, -0.3};
  light.position = {-0.7, 2.5, 0.4};
  light.colour = {5, 4, 3};
  light.outerConeAngle = 0.6;
  light.innerConeAngle = 0.4;
  light.litOutsideViews = setup.litOutside;
  light.cascadeFade = setup.fade;
  light.shadow.clipDepth = setup.clipDepth;
  light.shadow.views = viewsOf(setup, light);
  return light;
}

struct Rig {
  tests::FrameRig frame{kWidth, kHeight, sceneDepth(0.05)};
  tests::ShadowRig shadow;

  explicit Rig(const Setup& setup) {
    Frame& f = frame.frame;
    f.camera.viewFromWorld = tests::lookAt({0, 1, 6}, {0.1, 0.4, 0});
    f.camera.clipFromView = tests::reversedInfinite(0.9, 1.5, 0.05);
    f.camera.clipDepth = ClipDepth::ZeroToOne;
    f.medium.constituents = {
        {setup.monochrome ? Rgb{0.1F, 0.1F, 0.1F} : Rgb{0.05F, 0.1F, 0.2F}, Phase::HenyeyGreenstein, 0.3F},
        {{0.02F, 0.02F, 0.02F}, Phase::Rayleigh, 0}};
    f.settings.shadowFilter = setup.filter;
    f.lights = {lightOf(setup)};
    const int layers = setup.array ? setup.views : 1;
    shadow.image = {setup.size, setup.size, layers, casterDepths(setup.size, layers, setup.reversed, 7), {}, {}};
    if (setup.glass) {
      shadow.image.glassColour = tints(shadow.image.depth.size(), 11);
      shadow.image.glassDepth = casterDepths(setup.size, layers, setup.reversed, 13);
    }
    shadow.upload(f.lights[0], setup.array);
  }
};

void checkAgainstReference(const Setup& setup) {
  Rig rig(setup);
  const reference::ImageAnswer answer = rig.frame.render(), truth = rig.frame.reference({rig.shadow.image});
  const reference::ErrorMetrics error = reference::compare(answer.inscatter, truth.inscatter);
  INFO(error.text());
  CHECK(error.mean > 0);
  CHECK(error.rRmse <= 1e-3);
  CHECK(error.p99 <= 5e-3);
  const reference::ErrorMetrics t = reference::compare(answer.transmittance, truth.transmittance);
  CHECK(t.max <= 1e-5);
}

} // namespace

TEST_CASE("exact equals map-exact for every light, filter and convention", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const bool glass : {false, true})
        for (const bool reversed : {false, true})
          for (const ClipDepth clipDepth : {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne}) {
            Setup setup;
            setup.kind = kind;
            setup.views = kind == LightKind::Point ? 6 : 1;
            setup.filter = filter;
            setup.glass = glass;
            setup.reversed = reversed;
            setup.clipDepth = clipDepth;
            setup.monochrome = glass != reversed;
            CAPTURE(static_cast<int>(kind), static_cast<int>(filter), glass, reversed, static_cast<int>(clipDepth));
            checkAgainstReference(setup);
          }
}

TEST_CASE("exact equals map-exact where the light is dark outside the views", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot}) {
    Setup setup;
    setup.kind = kind;
    setup.litOutside = false;
    CAPTURE(static_cast<int>(kind));
    checkAgainstReference(setup);
  }
}

TEST_CASE("exact equals map-exact with cascades, maps of one layer and one texel", "[sweep]") {
  Setup cascades;
  cascades.views = 4;
  checkAgainstReference(cascades);
  cascades.litOutside = false;
  checkAgainstReference(cascades);
  for (const double fade : {0.02, 0.2, 0.5}) {
    CAPTURE(fade);
    cascades.fade = fade;
    checkAgainstReference(cascades);
  }
  Setup flat;
  flat.array = false;
  checkAgainstReference(flat);
  for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
    Setup tiny;
    tiny.size = 1;
    tiny.filter = filter;
    checkAgainstReference(tiny);
  }
}

TEST_CASE("exact equals map-exact in a shadow map of 1024 x 1024", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
    Setup setup;
    setup.kind = kind;
    setup.views = kind == LightKind::Point ? 6 : 1;
    setup.size = 1024;
    CAPTURE(static_cast<int>(kind));
    checkAgainstReference(setup);
  }
}
