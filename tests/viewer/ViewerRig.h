// A viewer with a clock of its own.
#pragma once

#include "support/Catch.h"
#include "support/TemporaryFolder.h"
#include "support/TestContext.h"

#include <viewer/core/Viewer.h>

namespace tests {

inline std::filesystem::path sceneFile(const std::string& name) {
  return std::filesystem::path(TYNDALL_SCENES_DIR) / (name + ".glb");
}

class ViewerRig {
public:
  explicit ViewerRig(int width = 96, int height = 54) : viewer(testContext(), {}) {
    viewer.resize(width, height);
    viewer.measuresErrors = false;
  }

  /// Loads it, with small maps.
  void load(const std::string& scene) {
    viewer.open(sceneFile(scene));
    runUntil([&] { return !viewer.loader().isLoading(); });
    REQUIRE(viewer.scene());
    settings::State state = viewer.state();
    state.shadowSize = 256;
    viewer.edit("map", state);
  }

  /// Until there is nothing left to do.
  int settle() {
    return runUntil([&] { return last == viewer::Activity::Idle && viewer.isSettled(); });
  }

  /// Calls update(), 20 ms later each time; returns how often it drew.
  template <typename Condition>
  int runUntil(const Condition& holds) {
    int drawn = 0;
    for (int i = 0; i < 20000; ++i) {
      step();
      drawn += last == viewer::Activity::Drew ? 1 : 0;
      if (holds()) return drawn;
      if (last == viewer::Activity::Waiting) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    FAIL("it does not come to an end");
    return drawn;
  }

  void step() { last = viewer.update(now += 0.02); }

  std::string error() {
    const std::optional<viewer::Message> message = viewer.takeMessage();
    return message && message->isError ? message->text : std::string();
  }

  viewer::Viewer viewer;
  viewer::Activity last = viewer::Activity::Idle;
  double now = 100;
};

} // namespace tests
