// A thousand effects, and a thousand sizes of one: nothing is left behind, and nothing piles up.
#include "gl/effect/FaultSweep.h"
#include "gl/effect/GlState.h"
#include "stress/sequences/Random.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <unistd.h>

using namespace tyndall;

namespace {

constexpr int kTimes = 1000;

// Bytes of this process in memory; 0 where the system does not say.
std::uint64_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

int sumOf(const std::map<std::string, int>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0,
                         [](int sum, const auto& entry) { return sum + entry.second; });
}

} // namespace

TEST_CASE("a thousand effects that draw leave no GL object behind", "[once]") {
  tests::FaultyContext context;
  tests::Stage stage(tests::frameCase("detect, a part"));
  stage.draw(*tests::newEffect({context.loader()})); // what GL keeps of programs
  const std::vector<int> before = tests::liveGlObjects();
  context.resetCounts();
  for (int i = 0; i < kTimes; ++i) {
    const std::unique_ptr<Effect> effect = tests::newEffect({context.loader()});
    const Status status = effect->render(stage.frame());
    if (!status) FAIL(status.message);
  }
  CHECK(sumOf(context.counts().made) > 20 * kTimes);
  CHECK(sumOf(context.counts().made) == sumOf(context.counts().deleted));
  CHECK(tests::liveGlObjects() == before);
}

TEST_CASE("a thousand effects that are made and given up take no more memory than the first hundred", "[once]") {
  const auto make = [](int times) {
    for (int i = 0; i < times; ++i)
      tests::newEffect();
  };
  make(kTimes / 10);
  const std::uint64_t before = residentBytes();
  make(kTimes);
  const std::uint64_t after = residentBytes();
  CAPTURE(before, after);
  CHECK(after <= before + (std::uint64_t{1} << 20));
}

TEST_CASE("a thousand sizes through one effect: bytes stay bounded, and the picture is that of a fresh one", "[once]") {
  constexpr int kKept = 8; // last frames whose textures are kept
  tests::FaultyContext context;
  for (const char* name : {"epipolar", "detect, nothing"}) {
    CAPTURE(name);
    const tests::FrameCase& item = tests::frameCase(name);
    const std::unique_ptr<Effect> effect = tests::newEffect({context.loader()});
    stress::Random random(7);
    std::uint64_t most = 0, mostOfOne = 0, eye = 0;
    for (int i = 0; i < kTimes / 2; ++i) {
      tests::Stage stage(item, random.between(2, 60), random.between(2, 60));
      if (eye == 0) eye = stage.frame().reuse.eye;
      stage.frame().reuse.eye = eye;
      const tests::TargetContents drawn = stage.draw(*effect);
      most = std::max(most, effect->statistics().bytes);
      if (i % 20 != 0) continue;
      const std::unique_ptr<Effect> fresh = tests::newEffect({context.loader()});
      CAPTURE(i, stage.frame().viewport.width, stage.frame().viewport.height);
      CHECK(tests::same(tests::bitEqual(drawn, stage.draw(*fresh)), true));
      mostOfOne = std::max(mostOfOne, fresh->statistics().bytes);
    }
    tests::Stage largest(item, 60, 60);
    const std::unique_ptr<Effect> fresh = tests::newEffect({context.loader()});
    largest.draw(*fresh);
    mostOfOne = std::max(mostOfOne, fresh->statistics().bytes);
    CHECK(most <= (kKept + 1) * mostOfOne);
  }
}
