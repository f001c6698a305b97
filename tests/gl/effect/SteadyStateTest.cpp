// What a frame costs in calls: none waits for the GPU, none makes or deletes an object once what a view needs is there,
// and there are few.
#include "FaultyContext.h"
#include "FrameCases.h"
#include "support/Catch.h"

#include <algorithm>
#include <set>

using namespace tyndall;
using tests::FaultyContext;
using tests::FrameCase;
using tests::newEffect;
using tests::Stage;

namespace {

void render(Effect& effect, const Frame& frame) {
  const Status status = effect.render(frame);
  INFO(status.message);
  REQUIRE(status);
}

std::string text(const std::map<std::string, int>& counts) {
  std::string all;
  for (const auto& [name, count] : counts)
    all += " " + std::to_string(count) + " " + name;
  return all;
}

} // namespace

TEST_CASE("no frame waits for the GPU") {
  FaultyContext context;
  for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery})
    for (const FrameCase& item : tests::frameCases()) {
      if (!tests::canDraw(item)) continue;
      context.setMaxTextureSize(item.maxTextureSize);
      const std::unique_ptr<Effect> effect = newEffect(tests::configFor(item, context.loader(), timing));
      Stage stage(item);
      std::vector<std::string> waits;
      for (int i = 0; i < 5; ++i) {
        context.resetCounts();
        render(*effect, stage.frame());
        const std::vector<std::string>& now = context.counts().gpuWaits;
        waits.insert(waits.end(), now.begin(), now.end());
        if (timing == PassTiming::TimerQuery) effect->statistics(); // which may
        stage.advance();
      }
      CAPTURE(item.name, static_cast<int>(timing), waits.size());
      if (!waits.empty()) FAIL_CHECK("waits in " << waits.front());
    }
  CHECK(context.unknown() == std::set<std::string>());
}

TEST_CASE("frames like those before make and delete no GL object") {
  constexpr int kWarm = 10, kFrames = 5;
  FaultyContext context;
  for (const PassTiming timing : {PassTiming::Off, PassTiming::TimerQuery})
    for (const FrameCase& item : tests::frameCases()) {
      if (!tests::canDraw(item)) continue;
      context.setMaxTextureSize(item.maxTextureSize);
      const std::unique_ptr<Effect> effect = newEffect(tests::configFor(item, context.loader(), timing));
      Stage stage(item);
      for (int i = 0; i < kWarm + kFrames; ++i) {
        if (i == kWarm) context.resetCounts();
        render(*effect, stage.frame());
        stage.advance();
      }
      CAPTURE(item.name, static_cast<int>(timing));
      const tests::GlCounts& counts = context.counts();
      if (counts.objects() > 0) FAIL_CHECK("made:" << text(counts.made) << "; deleted:" << text(counts.deleted));
      CHECK(counts.compiles + counts.links == 0);
    }
}

TEST_CASE("views of two sizes in turn make and delete no GL object") {
  constexpr int kWarm = 10, kFrames = 4;
  FaultyContext context;
  for (const char* name : {"epipolar", "epipolar, two lights, all targets", "tree", "exact", "low rank",
                           "epipolar, spread", "view 9", "detect, a part", "objects, a part"}) {
    const std::unique_ptr<Effect> effect = newEffect({context.loader()});
    Stage large(tests::frameCase(name), 48, 32), small(tests::frameCase(name));
    large.frame().settings.slices = 48;
    large.frame().settings.samples = 128;
    for (int i = 0; i < kWarm + kFrames; ++i) {
      if (i == kWarm) context.resetCounts();
      for (Stage* stage : {&large, &small}) {
        render(*effect, stage->frame());
        stage->advance();
      }
    }
    CAPTURE(name);
    const tests::GlCounts& counts = context.counts();
    if (counts.objects() > 0) FAIL_CHECK("made:" << text(counts.made) << "; deleted:" << text(counts.deleted));
  }
}

TEST_CASE("sizes that change in every frame do not pile up textures, and those that are not used are given up") {
  constexpr int kFrames = 40, kKept = 8; // the last frames, whose textures are kept
  FaultyContext context;
  for (const char* name : {"epipolar", "exact, lamp, all targets", "detect, nothing"}) {
    CAPTURE(name);
    const FrameCase& item = tests::frameCase(name);
    const std::unique_ptr<Effect> effect = newEffect({context.loader()});
    std::uint64_t most = 0, mostOfOne = 0;
    std::uint64_t view = 0;
    for (int i = 0; i < kFrames; ++i) {
      Stage stage(item, 32 + 4 * i, 24 + 3 * i);
      if (view == 0) view = stage.frame().reuse.eye;
      stage.frame().reuse.eye = view;
      stage.frame().settings.slices = 32 + i;
      const std::unique_ptr<Effect> alone = newEffect({context.loader()});
      render(*alone, stage.frame());
      mostOfOne = std::max(mostOfOne, alone->statistics().bytes);
      render(*effect, stage.frame());
      most = std::max(most, effect->statistics().bytes);
    }
    CHECK(most <= (kKept + 1) * mostOfOne);
    Stage last(item);
    last.frame().reuse.eye = view;
    const std::unique_ptr<Effect> alone = newEffect({context.loader()});
    for (int i = 0; i <= kKept; ++i)
      for (Effect* each : {effect.get(), alone.get()})
        render(*each, last.frame());
    CHECK(effect->statistics().bytes == alone->statistics().bytes);
  }
}

TEST_CASE("a frame of one sun takes few GL calls") {
  FaultyContext context;
  struct Limit {
    StateMode state;
    int calls;
  };
  for (const Limit& limit : {Limit{StateMode::Restore, 500}, Limit{StateMode::Leave, 250}}) {
    const std::unique_ptr<Effect> effect = newEffect({context.loader(), PassTiming::Off, {}, limit.state});
    Stage stage(tests::frameCase("epipolar"), 96, 64);
    stage.frame().settings = settingsOf(Profile::High);
    for (int i = 0; i < 4; ++i) {
      context.resetCounts();
      render(*effect, stage.frame());
    }
    const int calls = context.calls();
    INFO(context.callsByName());
    CAPTURE(static_cast<int>(limit.state));
    CHECK(calls <= limit.calls);
  }
}
