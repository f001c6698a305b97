// What of a frame is drawn anew, from what is known of the last one (reuse/RedrawPlan.h, Keys.h, RedrawCounts.h).
#include "reuse/RedrawPlan.h"
#include "support/Catch.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace tyndall;

namespace {

// An eye that has shown a frame of two lights, whose depth and maps have versions.
struct Stage {
  gl::Functions gl;
  Framebuffers framebuffers{gl};
  KeptEye eye{gl, framebuffers, 1};
  Frame frame;
  FrameKey key;

  explicit Stage(Changes changes = Changes::Detect) {
    frame.depth = {5, false, 3};
    frame.lights.resize(2);
    for (Light& light : frame.lights) {
      light.shadow.texture = 7;
      light.shadow.version = 4;
    }
    frame.reuse.changes = changes;
    frame.reuse.frame = 10;
    key.settings = frame.settings;
    key.drawn = {0, 1};
    key.lights.resize(2);
    eye.makeRoomFor(2);
    eye.last = KeptPicture{key, depthOf(frame), frame.reuse.frame, true, frame.camera};
    for (std::size_t i = 0; i < 2; ++i) {
      eye.lights[i]->last = KeptSlices{};
      eye.lights[i]->last->maps = mapsOf(frame.lights[i]);
    }
    frame.reuse.frame = 11;
  }
  RedrawPlan plan() const { return planRedraw(eye, key, frame); }
};

bool isCompared(const LightRedraw& light, bool ends, bool rows) {
  return light.redraw == Redraw::Part && light.comparesEnds == ends && light.comparesRows == rows;
}

} // namespace

TEST_CASE("where versions say that nothing changed nothing is drawn") {
  const RedrawPlan plan = Stage().plan();
  CHECK(plan.picture == Redraw::Nothing);
  CHECK(plan.mayReuse);
  for (const LightRedraw& light : plan.lights)
    CHECK(light.redraw == Redraw::Nothing);
}

TEST_CASE("the first frame of an eye is drawn whole") {
  Stage stage;
  stage.eye.giveUp();
  CHECK(stage.plan().picture == Redraw::All);
  CHECK_FALSE(stage.plan().mayReuse);
}

TEST_CASE("what has another version, or none, or another texture is compared") {
  for (const std::uint64_t version : {std::uint64_t{0}, std::uint64_t{9}}) {
    Stage depth, map;
    depth.frame.depth.version = version;
    CHECK(depth.plan().picture == Redraw::Part);
    for (const LightRedraw& light : depth.plan().lights)
      CHECK(isCompared(light, true, false));
    map.frame.lights[1].shadow.version = version;
    CHECK(map.plan().picture == Redraw::Part);
    CHECK(map.plan().lights[0].redraw == Redraw::Nothing);
    CHECK(isCompared(map.plan().lights[1], false, true));
  }
  Stage other;
  other.frame.depth.texture = 6;
  other.frame.lights[0].glass.colour = 8;
  CHECK(isCompared(other.plan().lights[0], true, true));
  CHECK(isCompared(other.plan().lights[1], true, false));
  Stage bare; // no map, nothing to compare of it
  bare.frame.lights[0].shadow = {};
  bare.frame.depth.version = 0;
  CHECK(isCompared(bare.plan().lights[0], true, false));
}

TEST_CASE("what another camera, medium, setting or light touches is drawn anew") {
  Stage camera, light, order;
  camera.key.block.skyEnd = 1;
  CHECK(camera.plan().picture == Redraw::All);
  light.key.lights[1].block.lightRange = 3;
  CHECK(light.plan().picture == Redraw::All);
  CHECK(light.plan().lights[0].redraw == Redraw::Nothing);
  CHECK(light.plan().lights[1].redraw == Redraw::All);
  order.key.drawn = {1, 0};
  CHECK(order.plan().picture == Redraw::All);
}

TEST_CASE("only epipolar slices of one sample a pixel are drawn in parts") {
  const std::vector<std::function<void(Stage&)>> whole = {
      [](Stage& s) { s.frame.settings.technique = Technique::Tree; },
      [](Stage& s) { s.frame.settings.spreadThreshold = 0.1F; }, [](Stage& s) { s.eye.last->hasDepth = false; }};
  for (const auto& change : whole) {
    Stage stage;
    change(stage);
    CHECK(stage.plan().picture == Redraw::Nothing);
    stage.frame.depth.version = 0;
    CHECK(stage.plan().picture == Redraw::All);
  }
}

TEST_CASE("with objects, those tell what changed since the frame before, and versions do not") {
  Stage stage(Changes::Objects);
  stage.frame.depth.version = stage.frame.lights[0].shadow.version = 99;
  CHECK(stage.plan().picture == Redraw::Nothing);
  stage.frame.objects.emplace_back();
  CHECK(stage.plan().picture == Redraw::Part);
  for (const LightRedraw& light : stage.plan().lights)
    CHECK(isCompared(light, true, true));
  for (const std::uint64_t frame : {10, 12, 0}) { // not the one after the last
    stage.frame.reuse.frame = frame;
    CHECK(stage.plan().picture == Redraw::All);
  }
}

TEST_CASE("slices that are refreshed in turn are drawn though nothing has changed") {
  Stage stage;
  stage.frame.reuse.refreshFrames = 30;
  CHECK(stage.plan().picture == Redraw::Part);
  CHECK(isCompared(stage.plan().lights[0], false, false));
}

// Structured bindings count the fields: one more does not compile until it has a line here.
TEST_CASE("no setting may change unseen") {
  [[maybe_unused]] const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = Settings{};
  const std::vector<void (*)(Settings&)> changes = {[](Settings& s) { s.technique = Technique::Exact; },
                                                    [](Settings& s) { s.debugView = DebugView::Redrawn; },
                                                    [](Settings& s) { s.shadowFilter = ShadowFilter::Bilinear; },
                                                    [](Settings& s) { s.slices = 7; },
                                                    [](Settings& s) { s.samples = 64; },
                                                    [](Settings& s) { s.rowStep = 2; },
                                                    [](Settings& s) { s.minMaxTree = false; },
                                                    [](Settings& s) { s.breakThreshold = 1; },
                                                    [](Settings& s) { s.bendThreshold = 1; },
                                                    [](Settings& s) { s.leastWeight = 1; },
                                                    [](Settings& s) { s.averageThreshold = 1; },
                                                    [](Settings& s) { s.spreadThreshold = 1; },
                                                    [](Settings& s) { s.errorTarget = 0.5F; },
                                                    [](Settings& s) { s.lowRankTerms = 8; },
                                                    [](Settings& s) { s.sampleBudget = 5000; }};
  CHECK(changes.size() == 15);
  for (std::size_t change = 0; change < changes.size(); ++change) {
    CAPTURE(change);
    FrameKey frame, otherFrame;
    LightKey light, otherLight;
    CHECK(sameFrame(frame, otherFrame));
    CHECK(same(light, otherLight));
    changes[change](otherFrame.settings);
    changes[change](otherLight.settings);
    CHECK_FALSE(sameFrame(frame, otherFrame));
    CHECK_FALSE(same(light, otherLight));
  }
}

TEST_CASE("a light with another map's size, program or smoke is another") {
  const std::vector<void (*)(LightKey&)> changes = {[](LightKey& l) { l.map.width = 5; },
                                                    [](LightKey& l) { l.map.height = 5; },
                                                    [](LightKey& l) { l.variant.lightKind = 2; },
                                                    [](LightKey& l) { l.variant.shadowViews = 2; },
                                                    [](LightKey& l) { l.variant.glass = true; },
                                                    [](LightKey& l) { l.variant.bilinear = true; },
                                                    [](LightKey& l) { l.variant.shadowArray = true; },
                                                    [](LightKey& l) { l.variant.layers = 1; },
                                                    [](LightKey& l) { l.variant.monochrome = true; },
                                                    [](LightKey& l) { l.curves.texture = 3; },
                                                    [](LightKey& l) { l.block.lightColour.y = 1; }};
  for (std::size_t change = 0; change < changes.size(); ++change) {
    CAPTURE(change);
    LightKey light, other;
    changes[change](other);
    CHECK_FALSE(same(light, other));
    CHECK_FALSE(same(other, light));
  }
  LightKey smoke;
  smoke.curves.texture = 3;
  CHECK_FALSE(same(smoke, smoke)); // not known to be the same
  smoke.curves.version = 1;
  CHECK(same(smoke, smoke));
  FrameKey eye, none;
  eye.eyeCurves.texture = 3;
  CHECK_FALSE(sameFrame(eye, none));
  CHECK_FALSE(sameFrame(eye, eye));
  eye.eyeCurves.version = 1;
  CHECK(sameFrame(eye, eye));
}

TEST_CASE("frames that reuse nothing are not kept for 1, 2, 4, 8, then 16 frames") {
  Rests rests;
  const auto restsAfter = [&rests](double share) {
    rests.judge(share, 0.35);
    int frames = 0;
    while (rests.takeOne())
      ++frames;
    return frames;
  };
  std::vector<int> found;
  for (int i = 0; i < 8; ++i)
    found.push_back(restsAfter(0.9));
  CHECK(found == std::vector<int>{0, 1, 2, 4, 8, 16, 16, 16});
  CHECK(restsAfter(0.35) == 0); // no more than the share: quiet, and all begins anew
  CHECK(restsAfter(0.9) == 0);
  CHECK(restsAfter(0.9) == 1);
}

TEST_CASE("shares of frames that may reuse are told once, oldest first") {
  const gl::Functions gl;
  RedrawCounts counts(gl);
  CHECK(counts.lastShare() == 1);
  counts.add({100, 25, {}, true});
  counts.add({100, 100, {}, false});
  counts.add({0, 0, {}, true}); // no slices: drawn whole
  counts.add({50, 5, {}, true});
  CHECK(counts.lastShare() == 0.1);
  CHECK(counts.takeCounted() == std::vector<double>{0.25, 1, 0.1});
  CHECK(counts.takeCounted().empty());
  CHECK(counts.lastShare() == 0.1);
}

TEST_CASE("an eye remembers the last shapes of its meshes") {
  const auto mesh = [](std::uint32_t buffer, std::uint64_t version) {
    MeshVertices vertices;
    vertices.buffer = buffer;
    vertices.version = version;
    return vertices;
  };
  LastShapes shapes;
  CHECK(shapes.of(mesh(1, 1)) == nullptr);
  for (std::uint32_t i = 1; i <= 1024; ++i)
    shapes.set(mesh(i, 1));
  shapes.set(mesh(1, 2)); // in place of its first shape, and named last
  REQUIRE(shapes.of(mesh(1, 3)));
  CHECK(shapes.of(mesh(1, 3))->version == 2);
  CHECK(shapes.of(mesh(2, 1)));
  shapes.set(mesh(2000, 1)); // one too many: the one that was not named for longest goes
  CHECK(shapes.of(mesh(2, 1)) == nullptr);
  CHECK(shapes.of(mesh(1, 1)));
  shapes.clear();
  CHECK(shapes.of(mesh(2000, 1)) == nullptr);
}
