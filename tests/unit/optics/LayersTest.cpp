// What the effect makes of a medium's layers before shaders see them.
#include "optics/Blocks.h"
#include "optics/HeightFog.h"
#include "reference/HeightFog.h"
#include "support/Catch.h"

#include <cmath>

using namespace tyndall;
using glm::dvec3;

namespace {

Medium layeredMedium() {
  Medium medium;
  medium.constituents = {{{0.1F, 0.2F, 0.3F}, Phase::Isotropic, 0, 0}, {{0.01F, 0.01F, 0}, Phase::Rayleigh, 0, -1}};
  medium.absorption = {0.05F, 0, 0.05F};
  medium.absorptionLayer = 1;
  medium.layers = {{2, 3, -4}, {0, 50}};
  medium.up = {0, 0, 4};
  return medium;
}

} // namespace

TEST_CASE("coefficients belong to the layer that they follow, or to none") {
  const Medium medium = layeredMedium();
  CHECK(optics::isLayered(medium));
  CHECK(optics::extinctionOf(medium, 0) == dvec3(0.1F, 0.2F, 0.3F));
  CHECK(optics::extinctionOf(medium, 1) == dvec3(0.05F, 0, 0.05F));
  CHECK(optics::extinctionOf(medium, optics::kEverywhere) == dvec3(0.01F, 0.01F, 0));
  CHECK(optics::scatteringOf(medium, 1) == dvec3(0));
  Medium even = medium;
  even.absorptionLayer = even.constituents[0].layer = -1;
  CHECK_FALSE(optics::isLayered(even)); // layers that nothing follows cost nothing
  CHECK(optics::extinctionOf(even, optics::kEverywhere) == optics::extinctionOf(medium));
}

TEST_CASE("a layer's density is 1 at its height, falls along up, and is even below the ground") {
  const Medium medium = layeredMedium();
  const dvec3 origin(7, -3, 10);
  const optics::Density density = optics::densityOf(medium, 0, origin);
  CHECK(density.at(dvec3(1, 5, 2 - 10)) == Approx(1));
  CHECK(density.at(dvec3(0, 0, 5 - 10)) == Approx(std::exp(-1)));
  CHECK(density.at(dvec3(0, 0, -4 - 10)) == Approx(std::exp(2)));
  CHECK(density.at(dvec3(0, 0, -1e6)) == Approx(std::exp(2)));
  CHECK(optics::densityOf(medium, 1, origin).at(dvec3(0, 0, -1e9)) == Approx(std::exp(60)));
  Medium endless = medium;
  endless.layers[0].scale = kInfinity;
  CHECK(optics::densityOf(endless, 0, origin).at(dvec3(0, 0, 1e9)) == 1);
}

TEST_CASE("shaders' exponents are a layer's, whatever the camera") {
  Frame frame;
  frame.viewport = {0, 0, 4, 4};
  frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002, -1, 0, 0, -0.2002, 0};
  frame.camera.viewFromWorld[14] = -30; // the eye at z = 30
  frame.medium = layeredMedium();
  const blocks::FrameBlock block = optics::frameBlock(frame, {});
  REQUIRE(block.layerCount == 2);
  CHECK(block.layerUp[0].w == Approx((30 - 2) / 3.0));
  CHECK(block.layerUp[0].z == Approx(1 / 3.0));
  CHECK(block.layerExtinction[0].w == Approx(-2));
  CHECK(block.layerExtinction[1].w == Approx(-60));
  CHECK(block.phaseWeight[0].w == 1);
  CHECK(block.phaseWeight[1].w == 0);
  frame.medium.layers.clear();
  frame.medium.absorptionLayer = frame.medium.constituents[0].layer = -1;
  CHECK(optics::frameBlock(frame, {}).layerCount == 0);
}

// What a texture of half floats has to hold.
TEST_CASE("no ray brings more of a sun than the longest way says, and one comes near") {
  const Medium medium = layeredMedium();
  const dvec3 eye(0, 0, 8);
  constexpr double kLength = 40;
  const dvec3 bound = optics::longestWay(medium, eye, kLength);
  dvec3 most(0);
  for (int i = 0; i <= 40; ++i) {
    const double z = i / 20.0 - 1;
    const reference::Ray ray{eye, dvec3(std::sqrt(1 - z * z), 0, z)};
    const reference::HeightFog fog(medium, Light(), ray);
    dvec3 even(0), layer(0); // integrals of transmittance, and of that times the layer's density
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) {
      const double s = kLength * (k + 0.5) / kSteps;
      const dvec3 passed = glm::exp(-fog.eyeDepth(s)) * (kLength / kSteps);
      even += passed;
      layer += passed * std::exp(-std::max((eye.z + s * z - 2) / 3, -2.0));
    }
    most = glm::max(most, glm::max(even, layer));
  }
  for (int c = 0; c < 2; ++c) { // nothing is scattered everywhere in the third
    CAPTURE(c);
    CHECK(most[c] <= bound[c]);
    CHECK(most[c] >= 0.25 * bound[c]);
  }
}
