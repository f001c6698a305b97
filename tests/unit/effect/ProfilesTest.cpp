// The profiles: rows of settings from fast to exact.
#include "CheckFrame.h"
#include "support/Catch.h"

#include <string>

using namespace tyndall;

namespace {

const Profile kRising[] = {Profile::Performance, Profile::Balanced, Profile::High};

} // namespace

TEST_CASE("each profile's settings are ones that a frame may have") {
  for (const Profile profile : {Profile::Performance, Profile::Balanced, Profile::High, Profile::Reference}) {
    Frame frame;
    frame.viewport.width = frame.viewport.height = 1;
    frame.colour = frame.depth.texture = 1;
    frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.002, -1, 0, 0, -0.2002, 0};
    frame.settings = settingsOf(profile);
    const Status status = checkValues(frame);
    CAPTURE(static_cast<int>(profile), status.message);
    CHECK(status);
  }
}

TEST_CASE("a better profile is coarser in nothing") {
  for (int i = 0; i < 2; ++i) {
    const Settings less = settingsOf(kRising[i]), more = settingsOf(kRising[i + 1]);
    CAPTURE(i);
    CHECK(more.technique == Technique::Epipolar);
    CHECK(more.slices > less.slices);
    CHECK(more.samples > less.samples);
    CHECK(more.rowStep < less.rowStep);
    CHECK(more.breakThreshold < less.breakThreshold);
    CHECK(more.bendThreshold < less.bendThreshold);
    CHECK(more.leastWeight > less.leastWeight);
  }
}

TEST_CASE("High is what a frame has if it says nothing, Reference the same by the exact technique") {
  const auto isDefault = [](const Settings& s) {
    const Settings none;
    return s.slices == none.slices && s.samples == none.samples && s.rowStep == none.rowStep &&
           s.breakThreshold == none.breakThreshold && s.bendThreshold == none.bendThreshold &&
           s.leastWeight == none.leastWeight && s.shadowFilter == none.shadowFilter &&
           s.averageThreshold == none.averageThreshold && s.spreadThreshold == none.spreadThreshold &&
           s.sampleBudget == 0 && s.minMaxTree;
  };
  CHECK(isDefault(settingsOf(Profile::High)));
  CHECK(settingsOf(Profile::High).technique == Technique::Epipolar);
  CHECK(isDefault(settingsOf(Profile::Reference)));
  CHECK(settingsOf(Profile::Reference).technique == Technique::Exact);
}
