// A loader that lacks each function in turn: create() refuses and names it, or the picture is the same.
#include "gl/effect/FaultSweep.h"
#include "support/Catch.h"

#include <set>
#include <string>

using namespace tyndall;

namespace {

std::set<std::string> hidden, asked;
GlLoader real;

void* loadOthers(const char* name) {
  asked.insert(name);
  return hidden.count(name) != 0 ? nullptr : real(name);
}

} // namespace

TEST_CASE("a loader that lacks any function: create names it, or the pictures are the same", "[once]") {
  tests::FaultyContext context;
  real = context.loader();
  hidden.clear();
  asked.clear();
  std::vector<tests::Stage> stages;
  std::vector<std::vector<tests::TargetContents>> expected;
  for (const char* name : {"epipolar, two lights, all targets", "detect, a part", "exact"}) {
    stages.emplace_back(tests::frameCase(name));
    expected.push_back(tests::drawFrames(stages.back(), *tests::newEffect({loadOthers})));
  }
  const std::set<std::string> all = asked;
  REQUIRE(all.size() > 60);
  int refused = 0, drawn = 0;
  for (const std::string& name : all) {
    CAPTURE(name);
    hidden = {name};
    const CreateResult created = Effect::create({loadOthers});
    if (!created.effect) {
      ++refused;
      const bool told = created.status.message.find(name) != std::string::npos || name == "glGetString";
      CHECK(told); // without glGetString there is no telling whether a context is current
      continue;
    }
    ++drawn;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const std::vector<tests::TargetContents> pictures = tests::drawFrames(stages[i], *created.effect);
      for (std::size_t frame = 0; frame < pictures.size(); ++frame)
        CHECK(tests::same(tests::bitEqual(pictures[frame], expected[i][frame]), true));
    }
  }
  hidden.clear();
  CHECK(refused > 60);
  CHECK(drawn > 10);
}
