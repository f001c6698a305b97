// Effect::prepare(): draws nothing, and after it frames like that one compile nothing.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "GlState.h"
#include "RefusalRig.h"
#include "support/Catch.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace tyndall;
using tests::Call;
using tests::Compiling;
using tests::drawFrames;
using tests::Fault;
using tests::FaultyContext;
using tests::FrameCase;
using tests::newEffect;
using tests::same;
using tests::Stage;
using tests::Times;

namespace {

constexpr int kFrames = 3, kMostCalls = 200;

// Until all is compiled; what the last call said.
PrepareStatus prepareAll(Effect& effect, const Frame& frame) {
  PrepareStatus prepared;
  for (int i = 0; i < kMostCalls; ++i) {
    prepared = effect.prepare(frame);
    if (!prepared.status || prepared.ready()) break;
  }
  INFO(prepared.status.message);
  CHECK(prepared.ready());
  return prepared;
}

int draws() {
  int sum = 0;
  for (const Call call : {Call::DrawArrays, Call::DrawArraysInstanced, Call::DrawArraysIndirect, Call::DispatchCompute,
                          Call::ClearBufferfv, Call::ClearBufferiv, Call::BlitFramebuffer, Call::Clear,
                          Call::CopyTexSubImage2D, Call::CopyImageSubData})
    sum += tests::callRows()[static_cast<std::size_t>(call)].count;
  return sum;
}

// What is compiled, linked or loaded.
int built(const FaultyContext& context) {
  const tests::GlCounts& counts = context.counts();
  return counts.compiles + counts.links + counts.loadedBinaries;
}

} // namespace

TEST_CASE("prepare: frames like the one that was prepared compile nothing, in every frame of a view") {
  FaultyContext context;
  for (const FrameCase& item : tests::frameCases()) {
    if (!tests::canDraw(item)) continue;
    context.setMaxTextureSize(item.maxTextureSize);
    CAPTURE(item.name);
    Stage stage(item);
    const std::unique_ptr<Effect> effect = newEffect(tests::configFor(item, context.loader()));
    context.resetCounts();
    prepareAll(*effect, stage.frame());
    CHECK(context.counts().links > 0);
    context.resetCounts();
    for (int i = 0; i < kFrames; ++i) {
      stage.draw(*effect);
      stage.advance();
    }
    CHECK(built(context) == 0);
    prepareAll(*effect, stage.frame());
    CHECK(built(context) == 0);
  }
}

TEST_CASE("prepare draws nothing, and changes neither state nor targets") {
  FaultyContext context;
  for (const FrameCase& item : tests::frameCases()) {
    if (!tests::canDraw(item)) continue;
    context.setMaxTextureSize(item.maxTextureSize);
    CAPTURE(item.name);
    Stage stage(item);
    const std::unique_ptr<Effect> effect = newEffect(tests::configFor(item, context.loader()));
    stage.fill();
    const tests::TargetContents before = stage.read();
    PrepareStatus prepared;
    tests::GlState entry, exit;
    {
      const tests::Poison poison;
      entry = tests::captureGlState();
      context.resetCounts();
      prepared = effect->prepare(stage.frame());
      exit = tests::captureGlState();
      tests::Poison::lift();
    }
    CHECK(prepared.status);
    CHECK(draws() == 0);
    CHECK(context.counts().gpuWaits.empty());
    CHECK(same(entry, exit));
    CHECK(same(stage.read(), before));
  }
}

TEST_CASE("prepare does not disturb what is kept of a view") {
  FaultyContext context;
  for (const char* name : {"detect, first frame", "objects, first frame"}) {
    CAPTURE(name);
    Stage stage(tests::frameCase(name));
    const std::vector<tests::TargetContents> expected = drawFrames(stage, *newEffect({context.loader()}));
    const std::unique_ptr<Effect> effect = newEffect({context.loader()});
    stage.rewind();
    for (int i = 0; i < kFrames; ++i) {
      prepareAll(*effect, stage.frame());
      CHECK(same(stage.draw(*effect), expected[static_cast<std::size_t>(i)]));
      prepareAll(*effect, stage.frame());
      stage.advance();
    }
  }
}

TEST_CASE("prepare refuses what render refuses, in the same words") {
  tests::RefusalRig rig;
  const FaultyContext context;
  const std::unique_ptr<Effect> effect = newEffect({context.loader()});
  const std::vector<std::function<void(Frame&)>> breaks = {
      [](Frame& f) { f.viewport.width = 0; },
      [](Frame& f) {
        f.colour = 0;
        f.output = {};
      },
      [](Frame& f) { f.colour = 4000; },
      [](Frame& f) { f.depth.texture = f.colour; },
      [](Frame& f) { f.depth.multisampled = true; },
      [](Frame& f) { f.lights.resize(kMaxLights + 1); },
      [](Frame& f) { f.lights[0].direction = {0, 0, 0}; },
      [](Frame& f) { f.lights[1].shadow.views.resize(kMaxShadowViews + 1); },
      [](Frame& f) { f.lights[2].glass.depth = 0; },
      [](Frame& f) { f.lights[0].curves.texture = 4000; },
      [](Frame& f) { f.medium.constituents.resize(kMaxConstituents + 1); },
      [](Frame& f) { f.camera.clipFromView[0] = std::numeric_limits<double>::quiet_NaN(); },
      [](Frame& f) { f.settings.samples = 65; },
      [](Frame& f) { f.settings.debugView = static_cast<DebugView>(99); },
      [](Frame& f) {
        f.settings.technique = Technique::Exact;
        f.settings.debugView = DebugView::Slices;
      },
      [](Frame& f) {
        f.reuse.changes = Changes::Objects;
        f.objects.resize(1);
        f.objects[0].mesh = {4000, 0, 12, 3, 0};
      },
  };
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    CAPTURE(i);
    Frame broken = rig.frame;
    breaks[i](broken);
    const PrepareStatus prepared = effect->prepare(broken);
    const Status drawn = effect->render(broken);
    CHECK(prepared.status.code == StatusCode::InvalidFrame);
    CHECK_FALSE(prepared.ready());
    CHECK(prepared.status.code == drawn.code);
    CHECK(prepared.status.message == drawn.message);
  }
  tests::testContext().takeErrors(); // of bindings that checks try
}

TEST_CASE("prepare says when a program does not build, whichever, and builds it when it does") {
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar, two lights"));
  const std::unique_ptr<Effect> whole = newEffect({context.loader()});
  const tests::TargetContents expected = stage.draw(*whole);
  for (const Fault kind : {Fault::Compile, Fault::Link})
    for (const Times times : {Times::From, Times::Only}) {
      int call = 1;
      for (; call < kMostCalls; ++call) {
        CAPTURE(nameOf(kind), call);
        const std::unique_ptr<Effect> effect = newEffect({context.loader()});
        context.fail(kind, call, times);
        const PrepareStatus prepared = effect->prepare(stage.frame());
        if (!context.heal()) break;
        CHECK(prepared.status.code == StatusCode::ShaderError);
        prepareAll(*effect, stage.frame());
        CHECK(same(stage.draw(*effect), expected));
      }
      CHECK(call > 2);
    }
}

TEST_CASE("prepare waits for no compiler that works beside it") {
  FaultyContext context;
  context.setCompiling(Compiling::Parallel);
  for (const char* name : {"epipolar", "epipolar, two lights, all targets", "tree", "exact", "low rank, glass",
                           "epipolar, spread", "view 9", "detect, first frame", "objects, first frame"}) {
    CAPTURE(name);
    Stage stage(tests::frameCase(name));
    const std::unique_ptr<Effect> effect = newEffect({context.loader()});
    context.resetCounts();
    int calls = 0, left = std::numeric_limits<int>::max();
    PrepareStatus prepared;
    do {
      prepared = effect->prepare(stage.frame());
      CHECK(prepared.left <= left);
      left = prepared.left;
    } while (prepared.status && !prepared.ready() && ++calls < kMostCalls);
    INFO(prepared.status.message);
    CHECK(prepared.ready());
    CHECK(calls > 0);
    CHECK(context.counts().compileWaits.empty());
    context.resetCounts();
    drawFrames(stage, *effect);
    CHECK(context.counts().compileWaits.empty());
    CHECK(built(context) == 0);
  }
}

TEST_CASE("render draws the right picture before prepare is ready") {
  FaultyContext context;
  Stage stage(tests::frameCase("epipolar, two lights, all targets"));
  const tests::TargetContents expected = stage.draw(*newEffect({context.loader()}));
  context.setCompiling(Compiling::Parallel);
  const std::unique_ptr<Effect> effect = newEffect({context.loader()});
  CHECK_FALSE(effect->prepare(stage.frame()).ready());
  CHECK(same(stage.draw(*effect), expected));
}

TEST_CASE("prepare returns when all is compiled where nothing compiles beside it") {
  FaultyContext context;
  context.setCompiling(Compiling::NoThread);
  for (const char* name : {"epipolar, two lights", "objects, first frame"}) {
    Stage stage(tests::frameCase(name));
    const std::unique_ptr<Effect> effect = newEffect({context.loader()});
    context.resetCounts();
    CHECK(effect->prepare(stage.frame()).ready());
    CHECK(context.counts().links > 0);
    context.resetCounts();
    drawFrames(stage, *effect);
    CHECK(built(context) == 0);
  }
}

TEST_CASE("a first sun needs few programs") {
  FaultyContext context;
  const std::unique_ptr<Effect> effect = newEffect({context.loader()});
  Stage stage(tests::frameCase("epipolar"), 96, 64);
  stage.frame().settings = settingsOf(Profile::High);
  context.resetCounts();
  for (int i = 0; i < kFrames; ++i)
    stage.draw(*effect);
  CHECK(context.counts().links <= 12);
  CHECK(effect->statistics().compiledPrograms == context.counts().links);
}
