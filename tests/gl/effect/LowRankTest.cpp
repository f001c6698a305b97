// Technique lowrank: spans by differences of prefix sums (Chen 2011, 3.2) against the closed forms of technique tree.
#include "ShaftRig.h"
#include "support/Catch.h"

#include <algorithm>

using namespace tyndall;

namespace {

constexpr auto kEverywhere = [](int, int) { return true; };

Light lamp(LightKind kind, const Vec3& position, const Vec3& direction) {
  Light light = tests::shaftLight(kind);
  light.position = position;
  light.direction = direction;
  return light;
}

Light sun() { return tests::shaftLight(LightKind::Directional); }
Light spot() { return lamp(LightKind::Spot, {-0.6, 9.4, -7}, {0.1, -1, -0.3}); }
Light point() { return lamp(LightKind::Point, {-0.6, 8.5, -3.5}, {0, -1, 0}); }

double errorOf(tests::ShaftRig& rig, const reference::Image& truth, int terms) {
  rig.scene.frame.settings.lowRankTerms = terms;
  return tests::errorWhere(rig.picture(Technique::LowRank), truth, kEverywhere);
}

bool hasPass(const std::string& name) {
  const Statistics statistics = tests::testEffect().statistics();
  return std::any_of(statistics.passes.begin(), statistics.passes.end(),
                     [&](const PassStatistics& pass) { return pass.name == name && pass.skipped.empty(); });
}

// An isotropic medium, grey or not.
void setMedium(tests::ShaftRig& rig, const Rgb& scattering) {
  rig.scene.frame.medium = {};
  rig.scene.frame.medium.constituents = {{scattering}};
  rig.scene.frame.medium.farDistance = 60;
}

} // namespace

TEST_CASE("low rank comes near the closed form with its terms, for every kind of light", "[sweep]") {
  struct Case {
    Light light;
    double least; // error with eight terms; a spot's cone is that of the pixel's slice
  };
  for (const Case& item : {Case{sun(), 0.002}, Case{point(), 0.005}, Case{spot(), 0.03}})
    for (const bool grey : {true, false})
      for (const bool glass : {false, true}) {
        CAPTURE(static_cast<int>(item.light.kind), grey, glass);
        tests::ShaftRig rig(72, 48);
        setMedium(rig, grey ? Rgb{0.03F, 0.03F, 0.03F} : Rgb{0.01F, 0.03F, 0.06F});
        rig.addLight(item.light, 128, glass);
        const reference::Image truth = rig.picture(Technique::Tree);
        const double one = errorOf(rig, truth, 1), four = errorOf(rig, truth, 4), eight = errorOf(rig, truth, 8);
        CAPTURE(one, four, eight);
        CHECK(one > 0); // an approximation
        CHECK(four <= 0.03);
        CHECK(four <= one);
        CHECK(eight <= item.least);
      }
}

TEST_CASE("low rank holds for rays across a sun overhead, between a slice's ends") {
  tests::ShaftRig rig(72, 48);
  setMedium(rig, {0.05F, 0.05F, 0.05F});
  Light overhead = sun();
  overhead.direction = {0, -1, 0.01};
  rig.addLight(overhead);
  CHECK(errorOf(rig, rig.picture(Technique::Tree), 8) <= 0.003);
}

TEST_CASE("a peaked phase function of a directional light is outside the approximation") {
  tests::ShaftRig rig(72, 48);
  setMedium(rig, {0.03F, 0.03F, 0.03F});
  rig.scene.frame.medium.constituents[0].phase = Phase::HenyeyGreenstein;
  rig.scene.frame.medium.constituents[0].g = 0.9F;
  rig.addLight(sun());
  CHECK(errorOf(rig, rig.picture(Technique::Tree), 4) <= 0.02);
}

TEST_CASE("low rank is tree where the airlight has more than two coordinates") {
  const auto checkSame = [](tests::ShaftRig& rig) {
    CHECK(tests::difference(rig.picture(Technique::LowRank), rig.picture(Technique::Tree)) == 0);
  };
  tests::ShaftRig bounded(48, 32);
  Light light = sun();
  light.boundary = {true, {0, 9, 0}, {0, 1, 0}};
  bounded.addLight(light);
  checkSame(bounded);
}

TEST_CASE("low rank of a light that is not dimmed is finite and near") {
  tests::ShaftRig rig(48, 32);
  setMedium(rig, {1e-12F, 1e-12F, 1e-12F});
  rig.addLight(sun());
  CHECK(errorOf(rig, rig.picture(Technique::Tree), 4) <= 5e-7);
  setMedium(rig, {1e4F, 1e4F, 1e4F}); // nothing passes
  const reference::Image dense = rig.picture(Technique::LowRank);
  CHECK(tests::errorWhere(dense, rig.picture(Technique::Tree), kEverywhere) <= 0.02);
}

TEST_CASE("low rank behind glass: sums of tints along rows are what one texel at a time brings", "[sweep]") {
  struct Case {
    Light light;
    int cascades;
    double fade;
  };
  for (const Case& item :
       {Case{sun(), 1, 0}, Case{sun(), 3, 0}, Case{sun(), 3, 0.2}, Case{point(), 1, 0}, Case{spot(), 1, 0}})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear})
      for (const int terms : {1, 4, 7}) {
        CAPTURE(static_cast<int>(item.light.kind), item.cascades, item.fade, static_cast<int>(filter), terms);
        tests::ShaftRig rig(72, 48);
        setMedium(rig, {0.01F, 0.03F, 0.06F});
        Light light = item.light;
        light.cascadeFade = item.fade;
        if (item.cascades > 1) light.shadow.views = tests::shadowViews(light, item.cascades);
        rig.addLight(light, 128, true);
        Settings& settings = rig.scene.frame.settings;
        settings.shadowFilter = filter;
        settings.lowRankTerms = terms;
        settings.minMaxTree = false; // texel by texel
        const reference::Image texels = rig.picture(Technique::LowRank);
        settings.minMaxTree = true;
        const reference::Image sums = rig.picture(Technique::LowRank);
        CHECK(hasPass("light 0 tint sums"));
        // A light ray is told by its slice's row, up to half a pixel from the pixel's own ray.
        CHECK(tests::errorWhere(sums, texels, kEverywhere) <= 2e-3);
      }
}

TEST_CASE("an orthographic camera has no sums of tints: its rays cross a light ray at different distances") {
  tests::ShaftRig rig(72, 48);
  setMedium(rig, {0.03F, 0.03F, 0.03F});
  tests::DepthConvention orthographic;
  orthographic.orthographic = true;
  rig.setConvention(orthographic);
  rig.addLight(sun(), 128, true);
  const reference::Image truth = rig.picture(Technique::Tree);
  CHECK(errorOf(rig, truth, 8) <= 7.5e-4);
  CHECK_FALSE(hasPass("light 0 tint sums"));
}

TEST_CASE(
    "low rank comes to none of the light at least and to all of it at most, where it is no approximation any more") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
    for (const float g : {-0.99F, 0.0F, 0.99F})
      for (const float sigma : {0.05F, 5.0F}) {
        CAPTURE(static_cast<int>(kind), g, sigma);
        tests::ShaftRig rig(48, 32);
        rig.scene.frame.medium.constituents = {{{sigma, 0.1F * sigma, 0.3F * sigma}, Phase::HenyeyGreenstein, g}};
        rig.addLight(tests::shaftLight(kind), 64);
        const reference::Image picture = rig.picture(Technique::LowRank);
        Light& light = rig.scene.frame.lights[0];
        light.shadow = {};
        const reference::Image most = rig.picture(Technique::Exact);
        CHECK(tests::isFiniteAndNonNegative(picture));
        double beyond = 0;
        for (std::size_t i = 0; i < most.rgb.size(); ++i)
          beyond = std::max(beyond, picture.rgb[i] - 1.002 * most.rgb[i]);
        CHECK(beyond <= 1e-30);
      }
}
