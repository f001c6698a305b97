// No draw too long: the bands of a target, and plans of frames none of whose draws may take longer than allowed
// (plan/Bands.h).
#include "plan/Bands.h"
#include "plan/DrawPlan.h"
#include "plan/PlanFrame.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace tyndall;

namespace {

// How often each pixel of the target is in a band; the target stands away from (0, 0).
std::vector<int> coverage(const Size& target, const Bands& bands) {
  const Viewport all{3, 5, target.width, target.height};
  std::vector<int> counts(static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height), 0);
  forEachBand(all, bands.size, [&](const Viewport& band) {
    for (int y = band.y; y < band.y + band.height; ++y)
      for (int x = band.x; x < band.x + band.width; ++x)
        ++counts.at(static_cast<std::size_t>(y - all.y) * static_cast<std::size_t>(target.width) +
                    static_cast<std::size_t>(x - all.x));
  });
  return counts;
}

bool isOnceEach(const std::vector<int>& counts) {
  return std::all_of(counts.begin(), counts.end(), [](int count) { return count == 1; });
}

int countOf(const Draw& draw) {
  int count = 0;
  forEachBand(draw.viewport, draw.bands.size, [&](const Viewport& /*band*/) { ++count; });
  return count;
}

// A frame of lights with shadow maps: some matrices and names, since nothing is drawn.
struct Planned {
  Frame frame;
  int mapSize = 4096;
  int depthSamples = 1;
  gl::Functions gl;
  const BandPaces* paces = nullptr;
  FramePlan plan;

  Planned(int width, int height, Technique technique) {
    frame.viewport.width = width;
    frame.viewport.height = height;
    frame.colour = 1;
    frame.depth.texture = 2;
    frame.camera.clipFromView = {1, 0, 0, 0, 0, 1.6, 0, 0, 0, 0, -1.01, -1, 0, 0, -0.2, 0};
    frame.medium.constituents = {{{0.1F, 0.1F, 0.1F}, Phase::Isotropic, 0}};
    frame.settings.technique = technique;
  }

  Light& add(LightKind kind) {
    Light light;
    light.kind = kind;
    light.position = {0, 0, -5};
    light.direction = {0.1, -1, 0.2};
    light.shadow.texture = 3;
    light.shadow.array = kind != LightKind::Spot;
    for (int i = 0; i < (kind == LightKind::Point ? 6 : 1); ++i)
      light.shadow.views.push_back({{0.1, 0, 0, 0, 0, 0, 0.1, 0, 0, 0.1, 0, 0, 0, 0, 0, 1}, i});
    frame.lights.push_back(light);
    return frame.lights.back();
  }

  std::vector<Draw> draws(double milliseconds) {
    Framebuffers framebuffers(gl);
    Targets targets(gl, framebuffers);
    Allocator allocator(framebuffers, false);
    FrameTextures textures;
    textures.depthSamples = depthSamples;
    textures.shadows.assign(frame.lights.size(), {mapSize, mapSize});
    const Limits limits{16384};
    PlannedFrame planned;
    Tuning tuning;
    tuning.bandMilliseconds = milliseconds;
    const PlanInputs inputs{frame, textures, limits, tuning, targets, nullptr, true, paces};
    FramePlanner(inputs, allocator, planned).plan();
    plan = planned.plan;
    std::vector<Draw> draws;
    for (const Step& step : plan.steps)
      if (const Draw* draw = std::get_if<Draw>(&step)) draws.push_back(*draw);
    return draws;
  }
};

const Draw& drawNamed(const std::vector<Draw>& draws, const std::string& title) {
  const auto found = std::find_if(draws.begin(), draws.end(), [&](const Draw& d) { return d.title == title; });
  REQUIRE(found != draws.end());
  return *found;
}

} // namespace

TEST_CASE("bands hold each pixel of a target once, and none takes longer than allowed") {
  std::mt19937 random(11);
  const auto within = [&random](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int i = 0; i < 2000; ++i) {
    const Size target{within(1, i % 2 ? 300 : 20), within(1, i % 3 ? 200 : 9)};
    const double nanoseconds = std::pow(10, within(-1, 5)), milliseconds = std::pow(10, -0.01 * within(0, 800));
    const Bands bands = bandsOf(target, nanoseconds, milliseconds);
    CAPTURE(target.width, target.height, nanoseconds, milliseconds, bands.size.width, bands.size.height);
    CHECK(isOnceEach(coverage(target, bands)));
    const bool isPixel = bands.size.width * bands.size.height == 1;
    CHECK((isPixel || bands.milliseconds <= milliseconds));
    CHECK(bands.milliseconds == Approx(1e-6 * nanoseconds * bands.size.width * bands.size.height));
  }
}

TEST_CASE("bands are as few and as even as whole blocks of pixels allow") {
  constexpr double kOnePerPixel = 1e6; // nanoseconds: a millisecond
  const auto sizeOf = [](int width, int height, double milliseconds) {
    const Size size = bandsOf({width, height}, kOnePerPixel, milliseconds).size;
    return std::pair(size.width, size.height);
  };
  CHECK(sizeOf(100, 50, 5000) == std::pair(100, 50)); // no longer than allowed
  CHECK(sizeOf(100, 50, 4999) == std::pair(100, 28)); // two of whole blocks of four rows, as even as they can be
  CHECK(sizeOf(100, 50, 2500) == std::pair(100, 20)); // three
  CHECK(sizeOf(100, 50, 400) == std::pair(100, 4));
  CHECK(sizeOf(100, 50, 399) == std::pair(52, 4)); // a row of blocks is too long
  CHECK(sizeOf(100, 50, 16) == std::pair(4, 4));
  CHECK(sizeOf(100, 50, 15) == std::pair(12, 1)); // a block is
  CHECK(sizeOf(100, 50, 3) == std::pair(3, 1));
  CHECK(sizeOf(100, 50, 0.5) == std::pair(1, 1)); // no less
  CHECK(sizeOf(100, 3, 300) == std::pair(100, 3));
  CHECK(sizeOf(100, 3, 299) == std::pair(52, 3));
  CHECK(sizeOf(1, 1, 1e-9) == std::pair(1, 1));
}

TEST_CASE("no draw of exact at 3840 x 2160 with a map of 8192 x 8192 takes longer than allowed") {
  for (const double milliseconds : {1.0, 20.0, 100.0, 400.0}) {
    Planned planned(3840, 2160, Technique::Exact);
    planned.mapSize = 8192;
    planned.add(LightKind::Directional);
    const std::vector<Draw> draws = planned.draws(milliseconds);
    const Draw exact = drawNamed(draws, "exact light 0");
    CAPTURE(milliseconds, exact.bands.size.width, exact.bands.size.height);
    // Rays by the texels that each may cross, at a quarter of a nanosecond.
    const double all = 1e-6 * 3840.0 * 2160 * (2 * 8192) * 0.25;
    CHECK(exact.bands.milliseconds <= milliseconds);
    CHECK(exact.bands.milliseconds >= all * exact.bands.size.width * exact.bands.size.height / (3840.0 * 2160));
    CHECK(isOnceEach(coverage({3840, 2160}, exact.bands)));
    CHECK(countOf(exact) >= all / milliseconds);
    CHECK(countOf(exact) <= 2 * all / milliseconds);
  }
}

TEST_CASE("no draw of any technique takes longer than allowed, whatever the frame") {
  for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar, Technique::LowRank})
    for (const bool hostile : {false, true})
      for (const DebugView view : {DebugView::Composite, DebugView::NodeVisits, DebugView::Difference}) {
        if (technique == Technique::Exact && view == DebugView::NodeVisits) continue;
        Planned planned(hostile ? 7680 : 640, hostile ? 4320 : 480, technique);
        planned.mapSize = hostile ? 16384 : 2048;
        for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
          planned.add(kind).glass = {hostile ? 4U : 0U, hostile ? 5U : 0U};
        Settings& settings = planned.frame.settings;
        settings.debugView = view;
        if (hostile) {
          settings.slices = settings.samples = 8192;
          settings.shadowFilter = ShadowFilter::Bilinear;
          settings.spreadThreshold = 0.01F;
          settings.minMaxTree = false;
        }
        for (const double milliseconds : {5.0, 100.0}) {
          const std::vector<Draw> draws = planned.draws(milliseconds);
          CHECK(planned.plan.bandMilliseconds == milliseconds);
          for (const Draw& draw : draws) {
            CAPTURE(draw.title, hostile, milliseconds);
            CHECK(draw.bands.milliseconds > 0);
            CHECK(draw.bands.milliseconds <= milliseconds);
          }
        }
      }
}

TEST_CASE("a multisampled depth takes longer, in passes that read it") {
  Planned one(1920, 1080, Technique::Exact), eight = one;
  eight.frame.depth.multisampled = true;
  eight.depthSamples = 8;
  for (Planned* planned : {&one, &eight})
    planned->add(LightKind::Directional);
  const auto each = [](Planned& planned, const char* title) {
    const std::vector<Draw> draws = planned.draws(1e4);
    const Bands& bands = drawNamed(draws, title).bands;
    return bands.milliseconds / (static_cast<double>(bands.size.width) * bands.size.height);
  };
  CHECK(each(eight, "exact light 0") > each(one, "exact light 0"));
}

TEST_CASE("without a limit draws are whole, and with one those of a common frame are few") {
  Planned planned(2560, 1600, Technique::Epipolar);
  planned.add(LightKind::Spot);
  for (const Draw& draw : planned.draws(0))
    CHECK(draw.isWhole());
  int bands = 0, draws = 0;
  for (const Draw& draw : planned.draws(100)) {
    if (draw.variant.fragment == rowOf(Pass::FixupAllTexels).fragment) continue; // compiled ahead, not drawn
    bands += countOf(draw);
    ++draws;
  }
  CHECK(bands > draws); // the fix-up, if it had all pixels to do
  CHECK(bands <= draws + 10);
}

namespace {

// What a plan that is drawn calls, of what bands are about.
std::vector<std::string> calls;

gl::Functions loggedFunctions() {
  gl::Functions gl;
  gl.version = 33;
  gl.BindVertexArray = [](gl::Uint) {};
  gl.ActiveTexture = [](gl::Enum) {};
  gl.UseProgram = [](gl::Uint) {};
  gl.BindFramebuffer = [](gl::Enum, gl::Uint) {};
  gl.Viewport = [](gl::Int, gl::Int, gl::Sizei, gl::Sizei) {};
  gl.Enable = [](gl::Enum what) { calls.emplace_back(what == gl::SCISSOR_TEST ? "scissor on" : "on"); };
  gl.Disable = [](gl::Enum what) { calls.emplace_back(what == gl::SCISSOR_TEST ? "scissor off" : "off"); };
  gl.Scissor = [](gl::Int x, gl::Int y, gl::Sizei width, gl::Sizei height) {
    calls.push_back("box " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(width) + " " +
                    std::to_string(height));
  };
  gl.ClearBufferfv = [](gl::Enum, gl::Int, const gl::Float*) { calls.emplace_back("clear"); };
  gl.DrawArrays = [](gl::Enum, gl::Int, gl::Sizei) { calls.emplace_back("draw"); };
  gl.timerQueries = gl.countsSamples = true;
  gl.GenQueries = [](gl::Sizei, gl::Uint* name) { *name = 1; };
  gl.DeleteQueries = [](gl::Sizei, const gl::Uint*) {};
  gl.BeginQuery = [](gl::Enum, gl::Uint) { calls.emplace_back("begin query"); };
  gl.EndQuery = [](gl::Enum) { calls.emplace_back("end query"); };
  gl.QueryCounter = [](gl::Uint, gl::Enum) { calls.emplace_back("stamp"); };
  gl.Flush = [] { calls.emplace_back("flush"); };
  return gl;
}

Draw drawOf(const Size& target, double milliseconds, double limit) {
  Draw draw;
  draw.title = "pass";
  draw.blocks = {-1, -1, -1}; // none is bound
  draw.viewport = {0, 0, target.width, target.height};
  draw.bands = bandsOf(target, 1e6 * milliseconds / (target.width * target.height), limit);
  return draw;
}

std::vector<std::string> callsOf(const FramePlan& plan) {
  const gl::Functions gl = loggedFunctions();
  calls.clear();
  const BlockBuffers blocks(gl);
  PassRecorder recorder(gl, PassTiming::Off);
  BandPaces paces(gl);
  drawPlan(plan, gl, {1, 1, 1, blocks}, recorder, paces, {});
  return calls;
}

} // namespace

TEST_CASE("GL is not given more at once than a draw may take, and boxes hold for bands only") {
  FramePlan plan;
  plan.bandMilliseconds = 100;
  for (int i = 0; i < 3; ++i)
    plan.steps.emplace_back(drawOf({16, 16}, 45, 100));
  Draw counted = drawOf({16, 24}, 240, 100);
  counted.counting = {Count::Marched};
  plan.steps.emplace_back(counted);
  plan.steps.emplace_back(Clear{});
  plan.steps.emplace_back(drawOf({16, 16}, 20, 100));
  CHECK(callsOf(plan) ==
        std::vector<std::string>{"draw", "draw", "flush", "draw",                              //
                                 "begin query", "flush", "box 0 0 16 8", "scissor on", "draw", // 80 each
                                 "flush", "box 0 8 16 8", "draw", "flush", "box 0 16 16 8", "draw", "end query", //
                                 "scissor off", "clear", "draw"});
}

TEST_CASE("a draw that is learned from is stamped before its bands and after each") {
  FramePlan plan;
  plan.bandMilliseconds = 100;
  Draw draw = drawOf({16, 8}, 160, 100);
  draw.bands.estimate = 40;
  plan.steps.emplace_back(draw);
  CHECK(callsOf(plan) == std::vector<std::string>{"stamp", "box 0 0 16 4", "scissor on", "draw", "stamp", "flush",
                                                  "box 0 4 16 4", "draw", "stamp", "scissor off"});
}

TEST_CASE("without a limit a draw is one call and nothing is flushed") {
  FramePlan plan;
  for (int i = 0; i < 3; ++i)
    plan.steps.emplace_back(drawOf({16, 16}, 1e9, 0));
  CHECK(callsOf(plan) == std::vector<std::string>{"draw", "draw", "draw"});
}

TEST_CASE("what was learned of a draw makes its bands shorter or longer, and what may be too long is learned from") {
  static double now = 0, slower = 1;
  gl::Functions gl = loggedFunctions();
  gl.QueryCounter = [](gl::Uint, gl::Enum) {};
  gl.GetQueryObjectui64v = [](gl::Uint, gl::Enum what, gl::Uint64* value) {
    *value = what == gl::QUERY_RESULT ? static_cast<gl::Uint64>(1e6 * (now += slower)) : 1;
  };
  Planned planned(1920, 1080, Technique::Exact);
  planned.add(LightKind::Directional);
  planned.frame.output.transmittance = 9;
  const int known = countOf(drawNamed(planned.draws(100), "exact light 0"));
  for (const double pace : {0.25, 4.0, 100.0}) {
    BandPaces paces(gl);
    slower = pace;
    for (int frame = 0; frame < 2; ++frame) {
      paces.beginFrame();
      paces.begin("exact light 0", 1, 1);
      paces.endBand();
    }
    planned.paces = &paces;
    const std::vector<Draw> draws = planned.draws(100);
    const Draw exact = drawNamed(draws, "exact light 0");
    CAPTURE(pace, known, countOf(exact));
    const double learned = std::clamp(pace, 0.8, BandPaces::kMost); // whole blocks make up to twice as many
    CHECK(countOf(exact) >= 0.9 * learned * known);
    CHECK(countOf(exact) <= 2 * learned * known);
    CHECK(exact.bands.milliseconds <= 100);
    CHECK(exact.bands.estimate == Approx(exact.bands.milliseconds / paces.of("exact light 0")));
    CHECK(drawNamed(draws, "transmittance").bands.estimate == 0); // it follows no rays
  }
}
