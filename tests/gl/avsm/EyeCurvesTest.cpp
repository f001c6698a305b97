// Shafts behind smoke and hair (Frame::eyeCurves) against the reference and known answers, by every technique.
#include "../effect/MediaRig.h"
#include "../effect/ShaftRig.h"
#include "AvsmRig.h"
#include "reference/CameraRays.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/ShaftsLookup.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

using namespace tyndall;
using namespace tests::media;

namespace {

constexpr int kSize = 48;
constexpr double kNear = 0.5, kFar = 12;

// Balls of smoke before the eye, the first of which lets so much through.
std::vector<tests::Captured> puffs(unsigned seed, bool solid = true) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<tests::Captured> all;
  for (int puff = 0; puff < 12; ++puff) {
    glm::vec2 middle; // in this order, whatever the compiler
    middle.x = kSize * uniform(random);
    middle.y = kSize * uniform(random);
    const float radius = kSize * (0.15F + 0.2F * uniform(random)), at = 0.05F + 0.6F * uniform(random);
    const float thickness = 0.03F + 0.12F * uniform(random);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const float off = glm::length(glm::vec2(x, y) + 0.5F - middle) / radius;
        if (off >= 1) continue;
        const float half = thickness * std::sqrt(1 - off * off);
        all.push_back({{x, y, 0}, at - half, at + half, solid && puff == 0 ? 0 : std::exp(-12 * half)});
      }
  }
  return all;
}

// All of the picture, at one depth.
std::vector<tests::Captured> sheet(float depth, float passed) {
  std::vector<tests::Captured> all;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      all.push_back({{x, y, 0}, depth, depth, passed});
  return all;
}

// What stands before the eye of a rig.
struct Smoke {
  tests::AvsmRig map;

  explicit Smoke(bool packed = false) : map(config(packed)) {}

  static AvsmConfig config(bool packed) {
    AvsmConfig made;
    made.size = kSize;
    made.packed = packed;
    return made;
  }

  void enter(tests::SceneRig& rig, const std::vector<tests::Captured>& segments) {
    for (int i = 0; i < 2; ++i) // the memory grows
      map.capture(segments);
    REQUIRE(map.avsm().statistics().lost == 0);
    rig.frame.eyeCurves = {map.avsm().curves(), kNear, kFar};
    rig.eyeCurves = map.map();
  }
};

constexpr LightKind kKinds[] = {LightKind::Directional, LightKind::Point, LightKind::Spot};

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

tests::SceneRig sceneOf(LightKind kind, bool glass) {
  tests::SceneRig rig(24, 16);
  rig.addLight(kind, tests::Casters::Blocks, glass);
  rig.frame.medium = haze();
  return rig;
}

double rRmse(const reference::Image& image, const reference::Image& truth) {
  return reference::compare(image, truth).rRmse;
}

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

TEST_CASE("eye curves: layers of a look-up are dimmed as the picture is, its transmittance is the medium's") {
  if (!tests::hasAvsm()) return;
  tests::SceneRig rig(24, 16);
  rig.addLight(LightKind::Spot, tests::Casters::AllLit);
  rig.addLight(LightKind::Directional, tests::Casters::None);
  rig.frame.medium = haze();
  rig.frame.ambient = sky();
  rig.frame.settings.technique = Technique::Tree;
  for (double& distance : rig.distances)
    distance = 20;
  rig.setConvention({});
  constexpr tests::ShaftsLookup::Range kRange{0.5, 60};
  tests::ShaftsLookup clear(24, 16, 8, kRange), dimmed(24, 16, 8, kRange);
  clear.enter(rig.frame);
  rig.render();
  Smoke smoke;
  smoke.enter(rig, puffs(7));
  dimmed.enter(rig.frame);
  rig.render();
  for (int layer = 0; layer < 8; ++layer) {
    CAPTURE(layer);
    CHECK(tests::difference(dimmed.passed(layer), clear.passed(layer)) <= 1e-7);
  }
  // The frame as if surfaces stood at a layer's distance.
  for (const int layer : {3, 5}) {
    const auto pixels = static_cast<std::size_t>(24 * 16);
    const host::GlTexture depth =
        tests::floatTexture(GL_R32F, 24, 16, std::vector<float>(pixels, static_cast<float>(clear.distance(layer))));
    Frame frame = rig.frame;
    rig.frame.depth = {};
    rig.frame.depth.texture = depth.name();
    rig.frame.depth.encoding = DepthEncoding::Radial;
    rig.frame.settings.technique = Technique::Exact;
    rig.frame.lookup = {};
    const reference::Image truth = rig.render().inscatter;
    rig.frame = frame;
    CHECK(tests::difference(dimmed.light(layer), truth) <= 1e-3);
  }
}

TEST_CASE("eye curves: temporal reuse draws anew when they change, and only then") {
  if (!tests::hasAvsm()) return;
  for (const Changes changes : {Changes::Detect, Changes::Objects}) {
    tests::ShaftRig shafts(48, 32);
    shafts.addLight(tests::shaftLight(LightKind::Directional));
    tests::SceneRig& rig = shafts.scene;
    Frame& frame = rig.frame;
    Smoke smoke;
    smoke.enter(rig, puffs(1));
    frame.settings.technique = Technique::Epipolar;
    frame.reuse = {changes, 9100 + static_cast<std::uint64_t>(changes), 0, 1.0F, 0};
    frame.depth.version = frame.lights[0].shadow.version = 1;
    const auto shareOf = [&] {
      const reference::Image reused = rig.render().inscatter;
      const double share = tests::testEffect().statistics().redrawnShare;
      const Reuse reuse = frame.reuse;
      frame.reuse = {};
      CHECK(tests::difference(reused, rig.render().inscatter) <= 1e-5);
      frame.reuse = reuse;
      ++frame.reuse.frame;
      return share;
    };
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
    smoke.enter(rig, puffs(2));
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
    frame.eyeCurves.farDistance *= 2;
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
    frame.eyeCurves.curves.version = 0; // not known
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 1);
    frame.eyeCurves = {};
    CHECK(shareOf() == 1);
    CHECK(shareOf() == 0);
  }
}

TEST_CASE("eye curves that break their rules are refused, field and rule named") {
  if (!tests::hasAvsm()) return;
  tests::SceneRig rig = sceneOf(LightKind::Spot, false);
  Smoke smoke;
  smoke.enter(rig, puffs(1));
  const auto checkRefused = [&](const std::string& part, const std::function<void(Frame&)>& spoil) {
    Frame frame = rig.frame;
    spoil(frame);
    const Status status = tests::testEffect().render(frame);
    CAPTURE(status.message, part);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find("Frame::eyeCurves." + part) != std::string::npos);
  };
  const double nan = std::nan("");
  checkRefused("curves.nodes is 5", [](Frame& f) { f.eyeCurves.curves.nodes = 5; });
  checkRefused("curves.texture is texture 987654", [](Frame& f) { f.eyeCurves.curves.texture = 987654; });
  checkRefused("curves.texture", [](Frame& f) { f.eyeCurves.curves.texture = f.lights[0].shadow.texture; });
  checkRefused("curves.texture", [](Frame& f) { f.eyeCurves.curves.nodes = 16; }); // more layers than there are
  checkRefused("nearDistance is 0", [](Frame& f) { f.eyeCurves.nearDistance = 0; });
  checkRefused("nearDistance is nan", [&](Frame& f) { f.eyeCurves.nearDistance = nan; });
  checkRefused("farDistance is 0.5", [](Frame& f) { f.eyeCurves.farDistance = f.eyeCurves.nearDistance; });
  checkRefused("farDistance is nan", [&](Frame& f) { f.eyeCurves.farDistance = nan; });
  checkRefused("farDistance is inf", [](Frame& f) { f.eyeCurves.farDistance = kInfinity; });
  checkRefused("farDistance is 1e+09", [](Frame& f) { f.eyeCurves.farDistance = 1e9; });
}

TEST_CASE("eye curves: jitter, several depths a pixel, cascades, smoke before the light and any number of nodes") {
  if (!tests::hasAvsm()) return;
  SECTION("curves are of the camera at rest") {
    tests::SceneRig rig = sceneOf(LightKind::Spot, false);
    rig.frame.settings.technique = Technique::Exact;
    Smoke smoke;
    smoke.enter(rig, puffs(8));
    // By a whole pixel: the picture is the one beside it, of what the same distances hold.
    for (double& distance : rig.distances)
      distance = 9;
    rig.setConvention({});
    const reference::Image still = rig.render().inscatter;
    tests::SceneRig flat = sceneOf(LightKind::Spot, false);
    const reference::Image aside = [&] {
      flat.distances.assign(flat.distances.size(), 9);
      flat.setConvention({});
      flat.frame.settings.technique = Technique::Exact;
      flat.frame.eyeCurves = rig.frame.eyeCurves;
      Camera& camera = flat.frame.camera;
      camera.jitter = {1, 0};
      const glm::dmat4 by = glm::translate(glm::dmat4(1), glm::dvec3(2.0 / 24, 0, 0));
      camera.clipFromView = tests::toMat4(by * reference::toMat4(camera.clipFromView));
      return flat.render().inscatter;
    }();
    double most = 0, sum = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 1; x < 24; ++x) {
        const auto a = aside.at(x, y), b = still.at(x - 1, y);
        most = std::max(most, glm::length(a - b));
        sum += glm::length(b) / (16 * 23);
      }
    CHECK(sum > 0);
    CHECK(most <= 1e-3 * sum);
  }
  SECTION("several depths a pixel") {
    tests::SceneRig rig = sceneOf(LightKind::Spot, false);
    rig.frame.settings.technique = Technique::Exact;
    Smoke smoke;
    smoke.enter(rig, puffs(8));
    const std::vector<float> depth = rig.depth();
    rig.setMultisampledDepth(4, GL_DEPTH_COMPONENT32F, [&](int pixel, int sample) {
      return depth[static_cast<std::size_t>(pixel)] * (1 - 0.1F * static_cast<float>(sample));
    });
    const double with = rRmse(rig.render().inscatter, rig.reference().inscatter);
    rig.frame.eyeCurves = {};
    rig.eyeCurves = {};
    const double without = rRmse(rig.render().inscatter, rig.reference().inscatter);
    CAPTURE(with, without);
    CHECK(with <= without + 1e-3);
  }
  SECTION("cascades and smoke before the light") {
    tests::ShaftRig shafts(48, 32);
    Light sun = tests::shaftLight(LightKind::Directional);
    sun.shadow.views = tests::shadowViews(sun, 3);
    shafts.addLight(sun, 128);
    tests::SceneRig& rig = shafts.scene;
    AvsmConfig config = Smoke::config(false);
    config.layers = 3;
    tests::AvsmRig before(config);
    for (int i = 0; i < 2; ++i)
      before.capture(puffs(9));
    rig.frame.lights[0].curves = before.avsm().curves();
    rig.curves = {before.map()};
    Smoke smoke(true);
    smoke.enter(rig, puffs(8));
    rig.frame.settings.technique = Technique::Exact;
    const reference::Image exact = rig.render().inscatter;
    CHECK(rRmse(exact, rig.reference().inscatter) <= 2e-3); // as without smoke before the eye
    rig.frame.settings.technique = Technique::Tree;
    CHECK(rRmse(rig.render().inscatter, exact) <= 0.05);
  }
  SECTION("nodes") {
    for (const int nodes : {4, 12, 16})
      for (const bool packed : {false, true}) {
        tests::SceneRig rig = sceneOf(LightKind::Point, false);
        AvsmConfig config = Smoke::config(packed);
        config.nodes = nodes;
        tests::AvsmRig map(config);
        for (int i = 0; i < 2; ++i)
          map.capture(puffs(3));
        rig.frame.eyeCurves = {map.avsm().curves(), kNear, kFar};
        rig.eyeCurves = map.map();
        rig.frame.settings.technique = Technique::Exact;
        CAPTURE(nodes, packed);
        CHECK(rRmse(rig.render().inscatter, rig.reference().inscatter) <= 1e-3);
      }
  }
  SECTION("low rank says that it is tree") {
    tests::SceneRig rig = sceneOf(LightKind::Point, true);
    Smoke smoke;
    smoke.enter(rig, puffs(3));
    rig.frame.settings.technique = Technique::Tree;
    const reference::Image tree = rig.render().inscatter;
    rig.frame.settings.technique = Technique::LowRank;
    CHECK(rig.render().inscatter.rgb == tree.rgb);
    const Statistics statistics = tests::testEffect().statistics();
    const PassStatistics* pass = passNamed(statistics, "light 0 low rank");
    REQUIRE(pass);
    CHECK(pass->skipped == "what stands before the eye dims each ray in its own way");
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
