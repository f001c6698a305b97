// Shafts behind smoke and hair (Frame::eyeCurves) against the reference and known answers, by every technique.
#include "../effect/ShaftRig.h"
#include "EyeCurvesRig.h"

#include <functional>
#include <limits>

using namespace tyndall;
using namespace tests::media;
using namespace tests::eye;

namespace {

// All of the picture, at one depth.
std::vector<tests::Captured> sheet(float depth, float passed) {
  std::vector<tests::Captured> all;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      all.push_back({{x, y, 0}, depth, depth, passed});
  return all;
}

struct Change {
  const char* name;
  std::function<void(tests::SceneRig&)> make;
};

// What differs in how light is integrated.
const std::vector<Change> kChanges = {
    {"as it is", [](tests::SceneRig&) {}},
    {"bilinear", [](tests::SceneRig& rig) { rig.frame.settings.shadowFilter = ShadowFilter::Bilinear; }},
    {"layers", [](tests::SceneRig& rig) { rig.frame.medium = layered(); }},
    {"ambient light", [](tests::SceneRig& rig) { rig.frame.ambient = sky(); }},
    {"no tree", [](tests::SceneRig& rig) { rig.frame.settings.minMaxTree = false; }},
    {"no averages", [](tests::SceneRig& rig) { rig.frame.settings.averageThreshold = 0; }},
    {"dense", [](tests::SceneRig& rig) { rig.frame.medium.constituents[0].scattering = {0.5F, 0.2F, 1.0F}; }},
    {"spread", [](tests::SceneRig& rig) { rig.frame.settings.spreadThreshold = 0.01F; }},
    {"error target", [](tests::SceneRig& rig) { rig.frame.settings.errorTarget = 0.005F; }},
    {"no medium's dimming", [](tests::SceneRig& rig) { rig.frame.medium.dimsBackground = false; }}};

} // namespace

TEST_CASE("eye curves: exact is the reference's picture for all lights, filters, glass, layers and ambient light",
          "[sweep][slow]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : kKinds)
    for (const bool glass : {false, true})
      for (const Change& change : kChanges) {
        if (glass && std::string(change.name) == "no tree") break; // only what exact sees of it
        CAPTURE(static_cast<int>(kind), glass, change.name);
        tests::SceneRig rig = sceneOf(kind, glass);
        rig.frame.settings.technique = Technique::Exact;
        change.make(rig);
        const reference::ImageAnswer clear = rig.render();
        Smoke smoke(glass);
        smoke.enter(rig, puffs(5));
        const reference::ImageAnswer seen = rig.render(), wanted = rig.reference();
        CHECK(rRmse(seen.inscatter, wanted.inscatter) <= 1e-3);
        CHECK(rRmse(clear.inscatter, wanted.inscatter) > 0.1);
        CHECK(seen.transmittance.rgb == clear.transmittance.rgb);
      }
}

namespace {

struct Errors {
  double without, with; // as parts of the picture's mean without smoke
};

Errors errorsOf(Technique technique, LightKind kind, bool glass, const Change& change) {
  tests::ShaftRig shafts(96, 64);
  tests::SceneRig& rig = shafts.scene;
  shafts.addLight(tests::shaftLight(kind), 128, glass);
  change.make(rig);
  const auto pictureBy = [&](Technique by) {
    rig.frame.settings.technique = by;
    return rig.render().inscatter;
  };
  const reference::Image clear = pictureBy(Technique::Exact);
  const double without = rRmse(pictureBy(technique), clear);
  Smoke smoke;
  smoke.enter(rig, puffs(6, false));
  const reference::Image exact = pictureBy(Technique::Exact);
  return {without, rRmse(pictureBy(technique), exact) * meanOf(exact) / meanOf(clear)};
}

} // namespace

TEST_CASE("eye curves: every technique is as near to exact as without them", "[sweep][slow][once]") {
  if (!tests::hasAvsm()) return;
  for (const LightKind kind : kKinds)
    for (const Technique technique : {Technique::Tree, Technique::Epipolar, Technique::LowRank})
      for (const bool glass : {false, true})
        for (const Change& change : kChanges) {
          const bool isPlain = std::string(change.name) == "as it is";
          if ((glass || technique == Technique::LowRank) && !isPlain) continue;
          const auto [without, with] = errorsOf(technique, kind, glass, change);
          CAPTURE(static_cast<int>(kind), glass, change.name, static_cast<int>(technique), without, with);
          // Slices are up to half a pixel from the pixels that they serve: around a lamp, a quarter of a texel of
          // smoke.
          const bool aside = technique == Technique::Epipolar && kind != LightKind::Directional;
          CHECK(with <= 1.1 * without + (aside ? 0.03 : 0.001));
        }
}

TEST_CASE("eye curves: a sheet that lets nothing or half through cuts or halves the light behind it, by every camera") {
  if (!tests::hasAvsm()) return;
  tests::DepthConvention reversed, endless, parallel;
  reversed.reversed = true;
  reversed.clipDepth = ClipDepth::ZeroToOne;
  endless.infinite = true;
  parallel.orthographic = true;
  constexpr double kDistance = 5; // along the axis, from the eye or from the near plane
  for (const tests::DepthConvention& convention : {tests::DepthConvention{}, reversed, endless, parallel})
    for (const LightKind kind : kKinds)
      for (const Technique technique : {Technique::Exact, Technique::Tree}) {
        CAPTURE(convention.reversed, convention.infinite, convention.orthographic, static_cast<int>(kind),
                static_cast<int>(technique));
        tests::SceneRig rig = sceneOf(kind, false);
        rig.frame.settings.technique = technique;
        rig.setConvention(convention);
        const reference::Image whole = rig.render().inscatter;
        const std::vector<double> distances = rig.distances;
        const double from = convention.orthographic ? convention.near : 0;
        for (double& distance : rig.distances)
          distance = std::min(distance, from + kDistance);
        rig.setConvention(convention);
        const reference::Image cut = rig.render().inscatter;
        rig.distances = distances;
        rig.setConvention(convention);
        Smoke smoke;
        smoke.enter(rig, sheet(static_cast<float>((kDistance - kNear) / (kFar - kNear)), 0));
        CHECK(tests::difference(rig.render().inscatter, cut) <= 1e-3);
        smoke.enter(rig, sheet(static_cast<float>((kDistance - kNear) / (kFar - kNear)), 0.5F));
        reference::Image half = cut;
        for (std::size_t i = 0; i < half.rgb.size(); ++i)
          half.rgb[i] += 0.5 * (whole.rgb[i] - cut.rgb[i]);
        CHECK(tests::difference(rig.render().inscatter, half) <= 1e-3);
        smoke.enter(rig, sheet(0, 0.25F));
        reference::Image quarter = whole;
        const double near = from + kNear; // what lies before the planes is not dimmed
        for (double& distance : rig.distances)
          distance = near;
        const Frame frame = rig.frame;
        rig.frame.eyeCurves = {};
        rig.setConvention(convention);
        const reference::Image before = rig.render().inscatter;
        rig.frame.eyeCurves = frame.eyeCurves;
        rig.distances = distances;
        rig.setConvention(convention);
        for (std::size_t i = 0; i < quarter.rgb.size(); ++i)
          quarter.rgb[i] = before.rgb[i] + 0.25 * (whole.rgb[i] - before.rgb[i]);
        CHECK(tests::difference(rig.render().inscatter, quarter) <= 1e-3);
      }
}

TEST_CASE("eye curves: a strand as thin as a texel is whole, wherever slices' march samples are") {
  if (!tests::hasAvsm()) return;
  constexpr int kTexels = 64;
  tests::SceneRig rig(640, 64);
  Light sun = tests::shaftLight(LightKind::Directional);
  sun.direction = {0.9, -0.35, 0.15};
  rig.frame.lights = {sun};
  rig.frame.medium = haze();
  rig.distances.assign(rig.distances.size(), 15);
  rig.setConvention({});
  AvsmConfig config;
  config.size = kTexels;
  config.packed = false;
  tests::AvsmRig map(config);
  std::vector<tests::Captured> strand;
  for (int y = 0; y < kTexels; ++y)
    strand.push_back({{kTexels / 2, y, 0}, 0.1F, 0.1F, 0});
  for (int i = 0; i < 2; ++i)
    map.capture(strand);
  rig.frame.eyeCurves = {map.avsm().curves(), kNear, kFar};
  rig.frame.settings.samples = 256; // regular ones are 40 pixels apart, the strand is 10 wide
  rig.frame.settings.technique = Technique::Exact;
  const reference::Image exact = rig.render().inscatter;
  rig.frame.settings.technique = Technique::Epipolar;
  const double wanted = exact.at(325, 32).x / exact.at(360, 32).x;
  CHECK(wanted < 0.5);
  // The most that is left in its middle, in parts of what is beside it.
  const auto shallowest = [&](const reference::Image& image) {
    double most = 0;
    for (int y = 4; y < 60; ++y)
      most = std::max(most, image.at(325, y).x / exact.at(360, y).x);
    return most;
  };
  const reference::Image fast = rig.render().inscatter;
  CHECK(shallowest(fast) < wanted + 0.25); // samples are a quarter of its width apart
  CHECK(rRmse(fast, exact) < 0.01);
  rig.frame.settings.bendThreshold = std::numeric_limits<float>::infinity(); // by regular samples alone it is missed
  CHECK(shallowest(rig.render().inscatter) > wanted + 0.4);
}
