// Media that thin out with height (Medium::layers): unshadowed light against adaptive quadrature, limits, and rules.
#include "AirlightSweep.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

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

// From centimetres to as good as none; the eye in a layer, far above it with a ground or without, far below where density is 1.
std::vector<HeightLayer> layers() {
  return {{kHeight - 0.008, 1e-3},         {kHeight, 1e-3, kHeight - 0.009}, {kHeight + 0.25, 0.05},
          {kHeight - 0.4, 0.05},           {kHeight, 1, kHeight - 2},         {kHeight - 240, 30},
          {kHeight + 60, 30, kHeight - 1}, {kHeight, 1e4},                    {kHeight, 1e9}};
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
  for (const HeightLayer& layer : layers())
    for (const Vec3& position : {Vec3{1, 3, 1}, Vec3{0.5, 2.5, -30}, Vec3{1.05, 2.01, 2.9}}) {
      CAPTURE(layer.height, layer.scale, layer.ground, position[2]);
      CHECK(errorOf({lamp(position), onlyFog(layer)}) <= 1e-4);
      CHECK(errorOf({lamp(position), twoLayers(layer, {kHeight, 20})}) <= 1e-4);
    }
}

TEST_CASE("unshadowed spot light through layers equals adaptive quadrature", "[sweep]") {
  for (const HeightLayer& layer : layers()) {
    CAPTURE(layer.height, layer.scale, layer.ground);
    CHECK(errorOf({spot(), hazeAndFog(layer)}) <= 1e-4);
  }
}
