// Media that thin out with height (Medium::layers): unshadowed light against adaptive quadrature, limits, and rules.
#include "AirlightSweep.h"
#include "FrameCases.h"
#include "ShaftRig.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>

using namespace tyndall;
using tests::AirlightSweep;
using tests::errorOf;
using tests::kSweepEye;

namespace {

const double kHeight = kSweepEye[1];

Light sun(const Vec3& direction = {0.3, -0.6, -1}) {
  Light light;
  light.direction = direction;
  light.colour = {3, 2, 1};
  return light;
}

Light lamp(const Vec3& position) {
  Light light;
  light.kind = LightKind::Point;
  light.position = position;
  return light;
}

Light spot() {
  Light light = lamp({3, 4, -2});
  light.kind = LightKind::Spot;
  light.direction = {-0.6, -0.55, 0.2};
  light.innerConeAngle = 0.3;
  light.outerConeAngle = 0.6;
  return light;
}

// All of it follows one layer.
Medium onlyFog(const HeightLayer& layer) {
  Medium medium = tests::mediumOf({{}, Phase::HenyeyGreenstein, 0.6F});
  medium.constituents[0].layer = medium.absorptionLayer = 0;
  medium.layers = {layer};
  return medium;
}

// Haze everywhere and fog, of another phase.
Medium hazeAndFog(const HeightLayer& layer) {
  Medium medium = onlyFog(layer);
  medium.constituents.push_back({{0.2F, 0.1F, 0.05F}, Phase::Rayleigh});
  return medium;
}

// And one more layer above it.
Medium twoLayers(const HeightLayer& first, const HeightLayer& second) {
  Medium medium = hazeAndFog(first);
  medium.layers.push_back(second);
  medium.constituents[1].layer = 1;
  medium.constituents.push_back({{0.02F, 0.03F, 0.05F}, Phase::Isotropic});
  return medium;
}

// Of scales from 1e-3 to as good as none; the eye in a layer, far above it with a ground or without, far below where
// density is 1, and below a ground, by little and by most of what is seen.
std::vector<HeightLayer> layers() {
  return {{kHeight - 0.008, 1e-3},
          {kHeight, 1e-3, kHeight - 0.009},
          {kHeight + 0.25, 0.05},
          {kHeight - 0.4, 0.05},
          {kHeight, 1, kHeight - 2},
          {kHeight - 240, 30},
          {kHeight + 60, 30, kHeight - 1},
          {kHeight, 0.5, kHeight + 0.1},
          {kHeight + 2, 0.1, kHeight + 2},
          {kHeight, 1e4},
          {kHeight, 1e9}};
}

} // namespace

TEST_CASE("unshadowed directional light through one layer equals its closed form", "[sweep]") {
  for (const HeightLayer& layer : layers()) {
    CAPTURE(layer.height, layer.scale, layer.ground);
    CHECK(errorOf({sun(), onlyFog(layer)}) <= 1e-5);
  }
}

TEST_CASE("unshadowed directional light through layers equals adaptive quadrature", "[sweep]") {
  for (const HeightLayer& layer : layers()) {
    CAPTURE(layer.height, layer.scale, layer.ground);
    CHECK(errorOf({sun(), hazeAndFog(layer)}) <= 1e-5);
    CHECK(errorOf({sun(), twoLayers(layer, {kHeight, 20})}) <= 1e-5);
  }
}

TEST_CASE("a directional light that comes through layers equals adaptive quadrature", "[sweep]") {
  for (const HeightLayer& layer : layers())
    for (const Vec3& direction : {Vec3{0.3, -1, 0.4}, Vec3{0.3, -0.05, -1}}) {
      AirlightSweep sweep{sun(direction), hazeAndFog(layer)};
      sweep.light.boundary = {true, {0, kHeight + 0.2, 0}, {0, 1, 0}};
      CAPTURE(layer.height, layer.scale, layer.ground, direction[1]);
      CHECK(errorOf(sweep) <= 1e-5);
      sweep.medium = onlyFog(layer);
      CHECK(errorOf(sweep) <= 1e-5);
    }
}

TEST_CASE("unshadowed point light through layers equals adaptive quadrature", "[sweep]") {
  const std::vector<Vec3> positions = {{1, 3, 1}, {0.5, 2.5, -30}, {1.05, 2.01, 2.9}};
  std::size_t turn = 0;
  for (const HeightLayer& layer : layers()) {
    CAPTURE(layer.height, layer.scale, layer.ground, turn);
    CHECK(errorOf({lamp(positions[turn % 3]), onlyFog(layer)}) <= 1e-4);
    CHECK(errorOf({lamp(positions[++turn % 3]), twoLayers(layer, {kHeight, 20})}) <= 1e-4);
  }
}

TEST_CASE("unshadowed spot light through layers equals adaptive quadrature", "[sweep]") {
  for (const HeightLayer& layer : layers()) {
    CAPTURE(layer.height, layer.scale, layer.ground);
    CHECK(errorOf({spot(), hazeAndFog(layer)}) <= 1e-4);
  }
}

namespace {

// Fog on the floor of the scene of shafts, and haze.
Medium shaftFog(bool withHaze) {
  Medium medium;
  medium.layers = {{0, 1.5, -0.5}};
  medium.constituents = {{{0.06F, 0.06F, 0.06F}, Phase::HenyeyGreenstein, 0.4F, 0}};
  if (withHaze) medium.constituents.push_back({{0.004F, 0.006F, 0.01F}, Phase::Rayleigh});
  medium.farDistance = 60;
  return medium;
}

Light shadowed(LightKind kind) {
  Light light = tests::shaftLight(kind);
  light.colour = {3, 2, 1};
  return light;
}

} // namespace

TEST_CASE("exact through layers equals map-exact: every light, filter, glass, and light that loses some on its way") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const bool glass : {false, true})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
        tests::SceneRig rig;
        Light& light = rig.addLight(kind, tests::Casters::Blocks, glass);
        if (kind == LightKind::Directional && glass) light.boundary = {true, {0, 5, 0}, {0, 1, 0.1}};
        rig.frame.settings.technique = Technique::Exact;
        rig.frame.settings.shadowFilter = filter;
        for (const Medium& medium : {shaftFog(false), shaftFog(true), twoLayers({0.5, 0.7}, {1, 4, -1})}) {
          rig.frame.medium = medium;
          rig.frame.medium.farDistance = 40;
          const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
          CAPTURE(static_cast<int>(kind), glass, static_cast<int>(filter), medium.layers.size());
          CHECK(reference::compare(got.inscatter, wanted.inscatter).rRmse <= 1e-3);
          CHECK(tests::difference(got.transmittance, wanted.transmittance) <= 1e-5);
        }
      }
}

TEST_CASE(
    "every technique is as near to exact through layers as through an even medium, filtered or not, grey or not") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      tests::ShaftRig rig;
      rig.addLight(shadowed(kind));
      rig.scene.frame.settings.shadowFilter = filter;
      for (const Technique technique : {Technique::Tree, Technique::Epipolar, Technique::LowRank}) {
        Medium even = shaftFog(true);
        for (Constituent& c : even.constituents)
          c.layer = -1;
        rig.scene.frame.medium = even;
        rig.changed();
        const tests::ShaftError without = rig.error(rig.picture(technique));
        Medium greyHaze = shaftFog(true);
        greyHaze.constituents[1].scattering = {0.006F, 0.006F, 0.006F};
        for (const Medium& medium : {shaftFog(false), greyHaze, shaftFog(true)}) {
          rig.scene.frame.medium = medium;
          rig.changed();
          const tests::ShaftError with = rig.error(rig.picture(technique));
          CAPTURE(static_cast<int>(kind), static_cast<int>(filter), static_cast<int>(technique),
                  medium.constituents.size(), without.rRmse, with.displaced);
          CHECK(with.rRmse <= std::max(1.25 * without.rRmse, with.displaced) + 2e-3);
        }
      }
    }
}

TEST_CASE("views side by side in one texture show through layers what those of an array do") {
  // By how much of the light pictures differ, whose maps are the same but for the layout.
  const auto apart = [](tests::FrameCase item) {
    tests::Stage array(item);
    item.layout = tests::Layout::Atlas;
    tests::Stage atlas(item);
    const std::vector<float> wanted = array.draw(tests::testEffect())[1], got = atlas.draw(tests::testEffect())[1];
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      sum += static_cast<double>(wanted[i]);
      difference += std::abs(static_cast<double>(got[i]) - static_cast<double>(wanted[i]));
    }
    REQUIRE(sum > 0);
    return difference / sum;
  };
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar})
    for (const bool filtered : {false, true}) {
      tests::FrameCase item;
      item.technique = technique;
      item.lights = {LightKind::Point};
      item.targets = {false, true, true};
      item.bilinear = filtered;
      const double even = apart(item);
      item.fog = true;
      CAPTURE(static_cast<int>(technique), filtered, even);
      CHECK(apart(item) <= 1.5 * even + 1e-4);
    }
}

namespace {

// All of it sky, through a layer without end.
tests::FrameRig skyRig(const glm::dvec3& eye, const glm::dvec3& target, const HeightLayer& layer, bool haze) {
  tests::FrameRig rig(8, 8, std::vector<float>(64, 0.0F));
  rig.frame.camera.viewFromWorld = tests::lookAt(eye, target);
  rig.frame.camera.clipFromView = tests::reversedInfinite(0.4, 1, 0.1);
  rig.frame.camera.clipDepth = ClipDepth::ZeroToOne;
  rig.frame.medium = shaftFog(haze);
  rig.frame.medium.layers = {layer};
  rig.frame.medium.farDistance = kInfinity;
  return rig;
}

} // namespace

TEST_CASE("sky below the eye of a layer without ground, without end, is as bright as extinction lets it be") {
  for (const bool haze : {false, true})
    for (const LightKind kind : {LightKind::Directional, LightKind::Point}) {
      tests::FrameRig rig = skyRig({0, 40, 0}, {0, 0, -30}, {0, 3}, haze);
      rig.frame.medium.constituents[0].scattering[2] = 0;
      rig.frame.lights = {shadowed(kind)};
      rig.frame.lights[0].position = {2, 41, -3};
      const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
      CAPTURE(haze, static_cast<int>(kind));
      CHECK(tests::isFiniteAndNonNegative(got.inscatter));
      CHECK(tests::difference(got.inscatter, wanted.inscatter) <= 1e-4);
    }
}

TEST_CASE("a ray to the sky from below a ground keeps what lies below it") {
  for (const bool haze : {false, true})
    for (const LightKind kind : {LightKind::Directional, LightKind::Point}) {
      tests::FrameRig rig =
          skyRig({0, 1, 0}, {0, 4, -10}, {0, 3, 5}, haze); // level 4 above the eye, and thin above that
      rig.frame.ambient.radiance = {1, 1, 1};
      rig.frame.lights = {shadowed(kind)};
      rig.frame.lights[0].position = {2, 41, -3};
      const reference::ImageAnswer got = rig.render(), wanted = rig.reference();
      CAPTURE(haze, static_cast<int>(kind));
      CHECK(tests::difference(got.inscatter, wanted.inscatter) <= 1e-4);
      CHECK(tests::difference(got.transmittance, wanted.transmittance) <= 1e-5);
    }
}

TEST_CASE("a layer whose scale grows without end becomes an even medium") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
    tests::SceneRig rig;
    rig.addLight(kind);
    for (const Technique technique : {Technique::Exact, Technique::Epipolar}) {
      rig.frame.settings.technique = technique;
      rig.frame.medium = shaftFog(true);
      rig.frame.medium.constituents[0].layer = -1;
      rig.frame.medium.farDistance = 40;
      const reference::ImageAnswer even = rig.render();
      rig.frame.medium.constituents[0].layer = 0;
      for (const double scale : {1e9, kInfinity}) {
        rig.frame.medium.layers = {{0, scale}};
        const reference::ImageAnswer layered = rig.render();
        CAPTURE(static_cast<int>(kind), static_cast<int>(technique), scale);
        // Epipolar textures hold colours in half floats, in a unit that depends on the layers.
        CHECK(reference::compare(layered.inscatter, even.inscatter).rRmse <=
              (technique == Technique::Exact ? 1e-6 : 0x1p-11));
        CHECK(tests::difference(layered.transmittance, even.transmittance) <= 1e-6);
      }
    }
  }
}

TEST_CASE("low rank says why it takes a medium with layers as tree does") {
  tests::ShaftRig rig = tests::smallShaftRig(Technique::LowRank);
  rig.scene.frame.medium = shaftFog(true);
  const reference::Image lowRank = rig.picture(Technique::LowRank);
  const std::vector<PassStatistics> passes = tests::testEffect().statistics().passes;
  CHECK(std::any_of(passes.begin(), passes.end(), [](const PassStatistics& pass) {
    return pass.name == "light 0 low rank" && pass.skipped.find("two coordinates") != std::string::npos;
  }));
  CHECK(lowRank.rgb == rig.picture(Technique::Tree).rgb);
}
