// Fog that the effect lights (EyeCurves::albedo), against the reference and known answers, by every technique; and fog
// that Avsm::drawVolumes() captures, from the density to the picture.
#include "../effect/ShaftRig.h"
#include "EyeCurvesRig.h"
#include "VolumeRig.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

using namespace tyndall;
using namespace tests::media;
using namespace tests::eye;

namespace {

struct Change {
  const char* name;
  std::function<void(tests::SceneRig&)> make;
};

void lightFog(tests::SceneRig& rig) {
  rig.frame.eyeCurves.albedo = {0.9F, 0.7F, 0.5F};
  rig.frame.eyeCurves.phase = Phase::HenyeyGreenstein;
  rig.frame.eyeCurves.g = 0.3F;
}

const std::vector<Change> kChanges = {
    {"as it is", [](tests::SceneRig&) {}},
    {"no medium", [](tests::SceneRig& rig) { rig.frame.medium.constituents.clear(); }},
    {"a medium that scatters red alone",
     [](tests::SceneRig& rig) { rig.frame.medium.constituents[0].scattering = {0.05F, 0, 0}; }},
    {"bilinear", [](tests::SceneRig& rig) { rig.frame.settings.shadowFilter = ShadowFilter::Bilinear; }},
    {"layers", [](tests::SceneRig& rig) { rig.frame.medium = layered(); }},
    {"ambient light", [](tests::SceneRig& rig) { rig.frame.ambient = sky(); }},
    {"ambient light alone",
     [](tests::SceneRig& rig) {
       rig.frame.ambient = sky();
       rig.frame.medium.constituents.clear();
       rig.frame.lights[0].colour = {0, 0, 0};
     }},
    {"dense", [](tests::SceneRig& rig) { rig.frame.medium.constituents[0].scattering = {0.5F, 0.2F, 1.0F}; }},
    {"layers in ambient light",
     [](tests::SceneRig& rig) {
       rig.frame.medium = layered();
       rig.frame.medium.constituents.erase(rig.frame.medium.constituents.begin()); // nothing is everywhere
       rig.frame.medium.farDistance = kInfinity;
       rig.frame.ambient = sky();
     }},
    {"backwards", [](tests::SceneRig& rig) { rig.frame.eyeCurves.g = -0.7F; }}};

} // namespace

TEST_CASE("fog: exact is the reference's picture for all lights, media, filters, glass and ambient light",
          "[sweep][slow]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : kKinds)
    for (const bool glass : {false, true})
      for (const Change& change : kChanges) {
        const bool isPlain = change.name == kChanges[0].name || std::string(change.name) == "bilinear";
        if (glass && !isPlain) continue;
        CAPTURE(static_cast<int>(kind), glass, change.name);
        tests::SceneRig rig = sceneOf(kind, glass);
        rig.frame.settings.technique = Technique::Exact;
        Smoke smoke(glass, 8);
        smoke.enter(rig, puffs(7, false));
        lightFog(rig);
        change.make(rig);
        const Rgb albedo = std::exchange(rig.frame.eyeCurves.albedo, Rgb{});
        const reference::Image dark = rig.render().inscatter;
        rig.frame.eyeCurves.albedo = albedo;
        rig.frame.eyeCurves.dimsBackground = true;
        const reference::ImageAnswer seen = rig.render(), wanted = rig.reference();
        CHECK(rRmse(seen.inscatter, wanted.inscatter) <= 1e-3);
        CHECK(rRmse(dark, wanted.inscatter) > 0.05);
        CHECK(tests::difference(seen.transmittance, wanted.transmittance) <= 1e-5);
      }
}

TEST_CASE("fog: every technique is about as near to exact as where nothing lights it", "[sweep][slow][once]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot})
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      tests::ShaftRig shafts(96, 64);
      tests::SceneRig& rig = shafts.scene;
      shafts.addLight(tests::shaftLight(kind), 128, false);
      Smoke smoke;
      smoke.enter(rig, puffs(6, false));
      const auto error = [&] {
        rig.frame.settings.technique = Technique::Exact;
        const reference::Image exact = rig.render().inscatter;
        rig.frame.settings.technique = technique;
        return rRmse(rig.render().inscatter, exact);
      };
      const double dark = error();
      const Frame frame = rig.frame;
      for (const std::string name : {"no medium", "ambient light"}) {
        rig.frame = frame;
        lightFog(rig);
        std::find_if(kChanges.begin(), kChanges.end(), [&](const Change& c) { return c.name == name; })->make(rig);
        CAPTURE(static_cast<int>(kind), name, static_cast<int>(technique), dark);
        CHECK(error() <= 2 * dark + 0.01);
      }
    }
}

TEST_CASE("fog: a sheet that takes all scatters its albedo's share of the light there") {
  if (!tests::hasAvsm()) return;
  constexpr double kDistance = 5;
  std::vector<tests::Captured> sheet;
  const auto depth = static_cast<float>((kDistance - kNear) / (kFar - kNear));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      sheet.push_back({{x, y, 0}, depth, depth, 0});
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    tests::SceneRig rig(24, 16);
    Light sun;
    sun.direction = {0.3, -1, 0.2};
    sun.colour = {2, 3, 4};
    rig.frame.lights = {sun};
    rig.frame.settings.technique = technique;
    rig.distances.assign(rig.distances.size(), 20);
    rig.setConvention({});
    rig.frame.medium = {};
    Smoke smoke;
    smoke.enter(rig, sheet);
    rig.frame.eyeCurves.albedo = {1, 0.5F, 0.25F};
    rig.frame.eyeCurves.dimsBackground = true;
    const reference::ImageAnswer seen = rig.render();
    CAPTURE(static_cast<int>(technique));
    for (std::size_t i = 0; i < seen.inscatter.rgb.size(); ++i) {
      const std::size_t c = i % 3;
      const double wanted = static_cast<double>(sun.colour[c]) * static_cast<double>(rig.frame.eyeCurves.albedo[c]);
      REQUIRE(seen.inscatter.rgb[i] == Approx(wanted / (4 * glm::pi<double>())).epsilon(2e-3));
      REQUIRE(seen.transmittance.rgb[i] == 0);
    }
  }
}

TEST_CASE("fog: a sheet where it begins is lit on every ray") {
  if (!tests::hasAvsm()) return;
  std::vector<tests::Captured> all;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const float depth = 0.2F + 0.001F * static_cast<float>(x) + 0.0007F * static_cast<float>(y);
      all.push_back({{x, y, 0}, depth, depth, 0.5F});
      all.push_back({{x, y, 0}, depth, depth + 0.4F, 0.4F});
    }
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot}) {
    tests::SceneRig rig = sceneOf(kind, false);
    rig.frame.settings.technique = Technique::Exact;
    Smoke smoke;
    smoke.enter(rig, all);
    lightFog(rig);
    CAPTURE(static_cast<int>(kind));
    CHECK(rRmse(rig.render().inscatter, rig.reference().inscatter) <= 0.01);
  }
}

TEST_CASE("fog: transmittance is dimmed alike in full, in parts and alone") {
  if (!tests::hasAvsm()) return;
  tests::SceneRig rig = sceneOf(LightKind::Directional, false);
  Smoke smoke;
  smoke.enter(rig, puffs(7, false));
  lightFog(rig);
  rig.frame.eyeCurves.dimsBackground = true;
  const reference::ImageAnswer wanted = rig.reference();
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
    rig.frame.settings.technique = technique;
    CAPTURE(static_cast<int>(technique));
    CHECK(tests::difference(rig.render().transmittance, wanted.transmittance) <= 1e-5);
  }
  rig.frame.reuse.changes = Changes::Detect;
  for (int frame = 0; frame < 3; ++frame) { // the first in full, then nothing, then in parts
    if (frame == 2) {
      for (int y = 4; y < 9; ++y)
        for (int x = 6; x < 12; ++x)
          rig.distances[static_cast<std::size_t>(24 * y + x)] = 3;
      rig.setConvention({});
    }
    const reference::ImageAnswer seen = rig.render(), now = rig.reference();
    CAPTURE(frame);
    CHECK(tests::difference(seen.transmittance, now.transmittance) <= 1e-5);
  }
  rig.frame.reuse = {};
  rig.frame.lights[0].colour = {0, 0, 0}; // and nothing lit
  rig.frame.eyeCurves.albedo = {};
  rig.frame.medium = {};
  const reference::ImageAnswer now = rig.render();
  CHECK(tests::difference(now.transmittance, rig.reference().transmittance) <= 1e-5);
}

TEST_CASE("fog: near surfaces are served by samples, whatever the sky's distance, and lamps may be at the eye") {
  if (!tests::hasAvsm()) return;
  for (const bool headlamp : {false, true}) {
    tests::ShaftRig shafts(96, 64);
    tests::SceneRig& rig = shafts.scene;
    rig.frame.medium = {}; // to an infinite distance
    Light light = tests::shaftLight(headlamp ? LightKind::Point : LightKind::Directional);
    if (headlamp) light.position = {0, 0, 0};
    shafts.addLight(light, 128, false);
    Smoke smoke;
    smoke.enter(rig, puffs(6, false));
    lightFog(rig);
    rig.frame.settings.technique = Technique::Exact;
    const reference::Image exact = rig.render().inscatter;
    rig.frame.settings.technique = Technique::Epipolar;
    const reference::Image fast = rig.render().inscatter;
    CAPTURE(headlamp);
    CHECK(meanOf(exact) > 0);
    CHECK(rRmse(fast, exact) <= 0.07);
    CHECK(tests::testEffect().statistics().fixupPixels < 96 * 64 / 4);
  }
}

TEST_CASE("fog: a volume that holds all that is seen is the picture of a medium") {
  if (!tests::hasAvsm()) return;
  constexpr double kExtinction = 0.12;
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot}) {
    tests::SceneRig rig(48, 32);
    rig.addLight(kind, tests::Casters::Blocks);
    rig.frame.settings.technique = Technique::Exact;
    for (double& distance : rig.distances)
      distance = std::min(distance, 11.0);
    rig.setConvention({});
    rig.frame.medium = {};
    rig.frame.medium.constituents = {{{0.09F, 0.09F, 0.09F}, Phase::Rayleigh, 0}};
    rig.frame.medium.absorption = {0.03F, 0.03F, 0.03F};
    const reference::ImageAnswer wanted = rig.render();
    constexpr double kFirst = 1e-2, kLast = 13;
    Light eye;
    REQUIRE(eyeLight(rig.frame.camera, rig.frame.viewport, kFirst, kLast, eye));
    AvsmConfig config = tests::configOf(CurveReduction::WholeCurve, 32, 16);
    tests::AvsmRig map(config);
    AvsmVolume volume;
    volume.worldFromVolume = tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(60)));
    volume.extinction = kExtinction;
    const auto capture = [&](tests::AvsmRig& into, const Light& light) {
      REQUIRE(into.avsm().begin(2));
      REQUIRE(into.avsm().drawVolumes(light, {volume}));
      REQUIRE(into.avsm().resolve());
    };
    capture(map, eye);
    // A sun's light comes without loss, as a medium's does that has no boundary; a lamp's through the fog.
    tests::AvsmRig lampMap(config);
    if (kind == LightKind::Spot) {
      capture(lampMap, rig.frame.lights[0]);
      rig.frame.lights[0].curves = lampMap.avsm().curves();
    }
    rig.frame.medium = {};
    rig.frame.eyeCurves = {map.avsm().curves(), kFirst, kLast};
    rig.frame.eyeCurves.albedo = {0.75F, 0.75F, 0.75F};
    rig.frame.eyeCurves.phase = Phase::Rayleigh;
    rig.frame.eyeCurves.dimsBackground = true;
    CAPTURE(static_cast<int>(kind));
    const reference::ImageAnswer seen = rig.render();
    // Curves are lines between nodes of a quarter of an optical depth.
    const double mean = meanOf(wanted.inscatter);
    double worst = 0;
    for (std::size_t i = 0; i < seen.inscatter.rgb.size(); ++i)
      worst =
          std::max(worst, std::abs(seen.inscatter.rgb[i] - wanted.inscatter.rgb[i]) / (wanted.inscatter.rgb[i] + mean));
    CHECK(worst <= 0.02);
    CHECK(tests::difference(seen.transmittance, wanted.transmittance) <= 8e-3);
  }
}
