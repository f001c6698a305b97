// Unless the status is Ok nothing was drawn: whichever call of a frame fails, alone or with all after it, colour,
// outputs and GL state are as they were, and the next frame is right.
#include "FaultSweep.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

using namespace tyndall;
using tests::Fault;
using tests::FaultyContext;
using tests::Times;

namespace {

void checkAll(Fault kind) {
  FaultyContext context;
  int points = 0, number = 0;
  for (const tests::FrameCase& item : tests::frameCases()) {
    if (!tests::canDraw(item)) continue;
    CAPTURE(item.name);
    tests::FaultSweep sweep(context, item);
    // Each call fails in a fresh effect and in a used one, once with all after it and once alone; the other way round
    // in every second case, since the k-th call of one is not that of the other.
    const bool isOdd = number++ % 2 != 0;
    for (const Times times : {Times::From, Times::Only}) {
      tests::SweepOptions options{kind, times, (times == Times::Only) != isOdd};
      options.inTurn = true;
      const tests::Findings findings = sweep.run(options);
      points += findings.points();
      if (!findings.empty()) FAIL_CHECK(item.name << ": " << nameOf(options) << findings.text());
    }
  }
  CHECK(points > 0);
}

} // namespace

// Shaders and programs that do not build; textures, renderbuffers and buffers without memory; framebuffers that are
// refused. In one case: each kind would compile all programs again.
TEST_CASE("faults: whatever of a frame fails, and whichever of a kind, it draws nothing", "[once][slow]") {
  for (const Fault kind :
       {Fault::Compile, Fault::Link, Fault::Texture, Fault::Renderbuffer, Fault::Buffer, Fault::Framebuffer})
    checkAll(kind);
}

TEST_CASE("a context that is watched for calls and faults draws what the context itself does", "[slow]") {
  FaultyContext context;
  for (const tests::FrameCase& item : tests::frameCases()) {
    if (!tests::canDraw(item) || item.maxTextureSize > 0) continue;
    CAPTURE(item.name);
    tests::Stage stage(item);
    const CreateResult created = context.create();
    REQUIRE(created.effect);
    for (int i = 0; i < 2; ++i) {
      const tests::TargetContents watched = stage.draw(*created.effect);
      CHECK(tests::bitEqual(watched, stage.draw(tests::testEffect())));
      stage.advance();
    }
  }
  CHECK(context.unknown().empty());
}
