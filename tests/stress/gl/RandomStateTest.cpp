// Any GL state that an engine may leave, by seeds: the picture is that of a clean state, and the state is given back.
#include "RandomGlState.h"
#include "gl/effect/FaultSweep.h"
#include "gl/effect/GlState.h"
#include "gl/effect/HostileRows.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <memory>

using namespace tyndall;

namespace {

constexpr int kSeeds = 24;

// The frame over a state of the seed; every second one over objects that are bound everywhere, too.
tests::TargetContents drawOver(std::uint64_t seed, tests::Stage& stage, Effect& effect) {
  stage.fill();
  stress::Random random(seed);
  const auto poison = seed % 2 == 0 ? std::make_unique<tests::Poison>() : nullptr;
  stress::setRandomGlState(random);
  const tests::GlState before = tests::captureGlState();
  const Status status = effect.render(stage.frame());
  const tests::GlState after = tests::captureGlState();
  tests::leaveCleanState();
  INFO(status.message);
  CHECK(status);
  for (const auto& [name, values] : before) {
    CAPTURE(name);
    if (values != after.at(name)) FAIL_CHECK("is not given back");
  }
  return stage.read();
}

} // namespace

TEST_CASE("over any GL state the picture is that of a clean one, and the state is given back") {
  tests::testContext();
  tests::leaveCleanState();
  std::uint64_t seed = 1;
  for (const char* name : {"epipolar", "tree", "exact, lamp, all targets", "low rank", "detect, a part",
                           "objects, a part", "elsewhere, all targets", "view 9"}) {
    tests::Stage stage(tests::frameCase(name));
    const std::unique_ptr<Effect> effect = tests::newEffect();
    const std::vector<tests::TargetContents> clean = tests::drawFrames(stage, *effect);
    for (int i = 0; i < kSeeds / 3; ++i) {
      stage.rewind();
      for (const tests::TargetContents& expected : clean) {
        CAPTURE(name, seed);
        CHECK(tests::same(tests::bitEqual(drawOver(seed, stage, *effect), expected), true));
        stage.advance();
        ++seed;
      }
    }
  }
}
