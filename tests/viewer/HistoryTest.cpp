#include "support/Catch.h"

#include <viewer/core/FrameTimes.h>
#include <viewer/core/History.h>
#include <viewer/core/Playback.h>

namespace {

settings::State withSlices(settings::State state, int slices) {
  state.settings.slices = slices;
  return state;
}

} // namespace

TEST_CASE("an edit is undone and done again") {
  viewer::History history;
  history.reset({});
  const int start = history.state().settings.slices;
  CHECK_FALSE(history.canUndo());
  history.edit("slices", withSlices(history.state(), 5));
  history.endEdit();
  history.edit("slices", withSlices(history.state(), 6));
  CHECK(history.nameOfUndo() == "slices");
  history.undo();
  CHECK(history.state().settings.slices == 5);
  history.undo();
  CHECK(history.state().settings.slices == start);
  CHECK_FALSE(history.canUndo());
  history.redo();
  history.redo();
  CHECK(history.state().settings.slices == 6);
  CHECK_FALSE(history.canRedo());
  history.redo();
  CHECK(history.state().settings.slices == 6);
}

TEST_CASE("a slider that is dragged is undone at once, another edit ends what can be redone") {
  viewer::History history;
  history.reset({});
  for (int slices = 100; slices < 200; ++slices)
    history.edit("slices", withSlices(history.state(), slices));
  history.undo();
  CHECK(history.state().settings.slices == settings::State().settings.slices);
  history.edit("slices", withSlices(history.state(), 7));
  CHECK_FALSE(history.canRedo());
}

TEST_CASE("undo leaves camera, time and size as they are") {
  viewer::History history;
  history.reset({});
  history.edit("slices", withSlices(history.state(), 5));
  settings::State moved = history.state();
  moved.lookAt = settings::LookAt{{1, 2, 3}, {0, 0, 0}, 40};
  moved.seconds = 4;
  moved.width = 11;
  history.move(moved);
  history.undo();
  CHECK(history.state().settings.slices == settings::State().settings.slices);
  CHECK(history.state().lookAt->eye.x == 1);
  CHECK(history.state().seconds == 4);
  CHECK(history.state().width == 11);
}

TEST_CASE("the history's memory is bounded") {
  viewer::History history;
  history.reset({});
  for (int i = 1; i < 2000; ++i)
    history.edit("edit " + std::to_string(i), withSlices(history.state(), i));
  int steps = 0;
  for (; history.canUndo(); ++steps)
    history.undo();
  CHECK(steps == 500);
}

TEST_CASE("an animation loops, or ends, and is stepped frame by frame") {
  viewer::Playback playback;
  playback.isPlaying = true;
  CHECK(playback.advanced(1, 0.5, 2) == Approx(1.5));
  CHECK(playback.advanced(1.9, 0.2, 2) == Approx(0.1));
  playback.speed = 2;
  CHECK(playback.advanced(0, 0.5, 2) == Approx(1));
  playback.loops = false;
  CHECK(playback.advanced(1.9, 0.2, 2) == 2);
  CHECK_FALSE(playback.isPlaying);
  CHECK(viewer::Playback::stepped(0, 1, 2) == Approx(1 / 24.0));
  CHECK(viewer::Playback::stepped(0, -1, 2) == Approx(2));
  CHECK(viewer::Playback::stepped(2, 1, 2) == 0);
}

TEST_CASE("quantiles of frame times are of the last ones") {
  viewer::FrameTimes times;
  CHECK(times.quantile(0.5) == 0);
  for (int i = 0; i < 1000; ++i)
    times.add(i < 500 ? 1000 : i % 100, false);
  CHECK(times.times().size() == 240);
  CHECK(times.quantile(1) == 99);
  CHECK(times.quantile(0) == 0);
}
