// What else of a frame meets smoke before the eye (Frame::eyeCurves): look-ups, temporal reuse, jitter, several depths
// a pixel, cascades, smoke before the light; and what is refused.
#include "../effect/ShaftRig.h"
#include "EyeCurvesRig.h"
#include "reference/CameraRays.h"
#include "support/ShaftsLookup.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using namespace tests::media;
using namespace tests::eye;

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
  for (const float albedo : {-0.1F, 1.1F, std::nanf("")})
    checkRefused("albedo is", [&](Frame& f) { f.eyeCurves.albedo[1] = albedo; });
  checkRefused("albedo is (1, 0, 0): a medium of four constituents must scatter", [](Frame& f) {
    f.eyeCurves.albedo[0] = 1;
    f.medium.constituents.assign(4, {{0, 0.1F, 0.1F}});
  });
  checkRefused("phase is 4", [](Frame& f) { f.eyeCurves.phase = static_cast<Phase>(4); });
  checkRefused("g is 1", [](Frame& f) { f.eyeCurves.g = 1; });
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
        Smoke smoke(packed, nodes);
        smoke.enter(rig, puffs(3));
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
