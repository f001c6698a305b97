// Maps that are copied before they are read: what temporal reuse, preparation, bands and statistics make of that.
#include "MapLayoutRig.h"
#include "ReuseRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <string>

using namespace tyndall;
using tests::LaidMaps;
using tests::Layout;
using tests::ShaftRig;
using namespace tests::reuse;

namespace {

// Two lamps whose cube maps are of one size, so that they could share copies.
struct Lamps {
  ShaftRig rig{64, 48};
  std::vector<Light> plain;
  std::vector<LaidMaps> maps;

  Lamps() {
    Frame& frame = rig.scene.frame;
    for (const Vec3& position : {Vec3{-0.6, 6.4, -3.5}, Vec3{2.5, 4.5, -5}}) {
      Light light = lamp(LightKind::Point, position, {0, -1, 0});
      light.shadow.views = tests::faceViews(light);
      plain.push_back(rig.addLight(light, 48));
    }
    frame.settings.technique = Technique::Epipolar;
    frame.settings.shadowFilter = ShadowFilter::Bilinear; // marched pixels look into the maps
    frame.reuse = {Changes::Detect, newView()};
    frame.reuse.fullShare = 1;
    lay();
  }

  void lay() {
    maps.clear();
    for (std::size_t i = 0; i < plain.size(); ++i) {
      maps.emplace_back(rig.scene.shadow(i), Layout::Cube, 0.0F);
      maps.back().enter(rig.scene.frame.lights[i]);
    }
  }

  void move(int frame) {
    for (std::size_t i = 0; i < plain.size(); ++i)
      rig.scene.frame.lights[i] = plain[i];
    rig.setMoving({tumbling(frame)});
    for (std::size_t i = 0; i < plain.size(); ++i)
      plain[i] = rig.scene.frame.lights[i];
    lay();
  }
};

// Why copies of a light's maps were not made, or "made", or nothing if there is no such pass.
std::string copyOf(std::size_t light) {
  for (const PassStatistics& pass : tests::testEffect().statistics().passes)
    if (pass.name == "light " + std::to_string(light) + " map copy")
      return pass.skipped.empty() ? "made" : pass.skipped;
  return {};
}

} // namespace

TEST_CASE("cube maps in which a box moves: a frame that reuses is what it would be in full", "[sweep]") {
  Lamps lamps;
  for (int frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    lamps.move(frame);
    const Picture picture = reused(lamps.rig);
    if (frame > 0) CHECK(picture.share < 0.95);
    checkSame(picture, full(lamps.rig));
  }
}

TEST_CASE("copies of maps that are stated to be the same are kept, also when the camera turns") {
  Lamps lamps;
  Frame& frame = lamps.rig.scene.frame;
  frame.depth.version = frame.lights[0].shadow.version = frame.lights[1].shadow.version = 7;
  reused(lamps.rig);
  CHECK(copyOf(0) == "made");
  reused(lamps.rig);
  CHECK(copyOf(0) != "made"); // nothing is drawn
  const auto turn = [&](double x) {
    lamps.rig.look(tests::lookAt({0, 2, 0}, {x, 2, -1}));
    ++frame.depth.version;
  };
  turn(0.2);
  const Picture turned = reused(lamps.rig);
  CHECK(copyOf(0) == "the maps have not changed");
  CHECK(copyOf(1) == "the maps have not changed");
  checkSame(turned, full(lamps.rig));
  turn(0.3);
  ++frame.lights[1].shadow.version;
  const Picture changed = reused(lamps.rig);
  CHECK(copyOf(0) == "the maps have not changed");
  CHECK(copyOf(1) == "made");
  checkSame(changed, full(lamps.rig));
  frame.lights[0].shadow.scale.offset = 1; // the same texels mean something else
  frame.lights[0].shadow.encoding = DepthEncoding::Axial;
  const Picture encoded = reused(lamps.rig);
  CHECK(copyOf(0) == "made");
  checkSame(encoded, full(lamps.rig));
}

TEST_CASE("rectangles that move in their texture are not taken for what was there before", "[sweep]") {
  ShaftRig rig(64, 48);
  Light light = tests::shaftLight(LightKind::Directional);
  light.shadow.views = tests::shadowViews(light, 2);
  rig.addLight(light, 48);
  Frame& frame = rig.scene.frame;
  const Light plain = frame.lights[0];
  const LaidMaps atlas(rig.scene.shadow(0), Layout::Atlas, 0), sheets(rig.scene.shadow(0), Layout::Sheets, 0);
  frame.settings.technique = Technique::Epipolar;
  frame.reuse = {Changes::Detect, newView()};
  frame.depth.version = 7;
  for (const bool mixture : {false, true}) { // read as they are, or copied
    frame.settings.shadowFilter = mixture ? ShadowFilter::Bilinear : ShadowFilter::Nearest;
    if (mixture) frame.settings.spreadThreshold = 0.05F;
    for (const LaidMaps* maps : {&atlas, &sheets}) {
      frame.lights[0] = plain;
      maps->enter(frame.lights[0]);
      frame.lights[0].shadow.version = 7;
      checkSame(reused(rig), full(rig));
      std::swap(frame.lights[0].shadow.views[0].rectangle, frame.lights[0].shadow.views[1].rectangle);
      checkSame(reused(rig), full(rig));
    }
  }
}

TEST_CASE("what is prepared for cubes, atlases and encodings is all that is compiled", "[sweep]") {
  for (const Layout layout : {Layout::Cube, Layout::CubeArray, Layout::Atlas})
    for (const Changes changes : {Changes::Unknown, Changes::Detect}) {
      CAPTURE(static_cast<int>(layout), static_cast<int>(changes));
      const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, true, 16);
      Frame& frame = rig->scene.frame;
      const LaidMaps maps(rig->scene.shadow(0), layout, 0);
      maps.enter(frame.lights[0]);
      frame.settings.technique = Technique::Epipolar;
      frame.reuse = {changes, newView()};
      const std::unique_ptr<Effect> effect = tests::newEffect();
      while (!effect->prepare(frame).ready())
        REQUIRE(effect->prepare(frame).status);
      const int prepared = effect->statistics().compiledPrograms;
      for (int i = 0; i < 2; ++i)
        REQUIRE(effect->render(frame));
      CHECK(effect->statistics().compiledPrograms == prepared);
    }
}

TEST_CASE("copies are part of the memory that is held, and are drawn in bands where they are large") {
  const std::unique_ptr<ShaftRig> rig = tests::layoutRig(LightKind::Point, true, 64);
  Frame& frame = rig->scene.frame;
  frame.settings.technique = Technique::Exact;
  const LaidMaps atlas(rig->scene.shadow(0), Layout::Atlas, 0), cube(rig->scene.shadow(0), Layout::Cube, 0);
  Config config;
  config.tuning.bandMilliseconds = 0.005; // of 64 x 64 texels, 3 ns each, as Bands.cpp has it
  const Frame plain = frame;
  std::uint64_t bytes[2] = {};
  for (const bool copied : {false, true}) {
    frame = plain;
    (copied ? cube : atlas).enter(frame.lights[0]);
    const std::unique_ptr<Effect> effect = tests::newEffect(config);
    REQUIRE(effect->render(frame));
    const Statistics statistics = effect->statistics();
    bytes[copied ? 1 : 0] = statistics.bytes;
    int copies = 0;
    for (const PassStatistics& pass : statistics.passes)
      if (pass.name.find("map copy") != std::string::npos) {
        ++copies;
        CHECK(pass.bands > 1);
      }
    CHECK(copies == (copied ? 6 : 0));
  }
  CHECK(bytes[1] - bytes[0] == 6 * 64 * 64 * (4 + 4 + 16)); // depths of casters and glass, tints
}
