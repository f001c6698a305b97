// Failures at random sets of calls: of shaders, programs, textures, buffers and framebuffers together. Whatever fails,
// colour and outputs are as they were, and the next frame is right.
#include "gl/effect/FaultSweep.h"
#include "stress/sequences/Random.h"
#include "support/Catch.h"

using namespace tyndall;

TEST_CASE("faults: any calls of a frame, one in eight by chance, draw nothing, and the next frame is right", "[once]") {
  tests::FaultyContext context;
  stress::Random random(22);
  int points = 0;
  for (const char* name :
       {"epipolar, two lights, all targets", "tree, two lights, inscatter", "exact, lamp, all targets", "low rank",
        "epipolar, spread", "view 9", "detect, a part", "objects, third frame", "objects, mesh",
        "detect, redrawn, a part", "elsewhere, all targets", "layers, two lights"}) {
    const tests::FrameCase& item = tests::frameCase(name);
    CAPTURE(item.name);
    tests::FaultSweep sweep(context, item);
    for (const bool used : {false, true}) {
      tests::SweepOptions options{tests::Fault::Any, tests::Times::Random, used};
      options.firstSeed = random.below(1 << 20);
      options.seeds = 8;
      const tests::Findings findings = sweep.run(options);
      points += findings.points();
      if (!findings.empty()) FAIL_CHECK(item.name << ": " << nameOf(options) << findings.text());
    }
  }
  CHECK(points > 100);
}
