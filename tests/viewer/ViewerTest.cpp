// The viewer as its window uses it.
#include "../settings/RandomState.h"
#include "ViewerRig.h"

#include <algorithm>
#include <fstream>
#include <gl/ReadBack.h>
#include <scene/Error.h>
#include <scene/ImageFile.h>
#include <settings/StateFile.h>
#include <settings/Tables.h>

using viewer::Activity;

TEST_CASE("a viewer without a scene does nothing") {
  tests::ViewerRig rig;
  rig.step();
  CHECK(rig.last == Activity::Idle);
  rig.viewer.frameAll();
  rig.viewer.useSceneCamera(3);
  rig.viewer.setView(rig.viewer.view());
  rig.viewer.undo();
  const tests::TemporaryFolder folder;
  rig.viewer.savePicture(folder / "no-scene.png");
  CHECK(rig.error() == "there is no picture to save: no scene is loaded");
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a picture is whole soon after the last change, and then nothing is done") {
  tests::ViewerRig rig;
  rig.load("projector");
  rig.settle();
  CHECK(rig.viewer.first().width() == 96);
  for (int i = 0; i < 10; ++i) {
    rig.step();
    CHECK(rig.last == Activity::Idle);
  }
  rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.1, 0));
  rig.step();
  CHECK(rig.last == Activity::Drew);
  CHECK(rig.viewer.first().width() < 96); // fewer pixels while it moves
  CHECK_FALSE(rig.viewer.isSettled());
  rig.settle();
  CHECK(rig.viewer.first().width() == 96);
}

TEST_CASE("a scene that cannot be loaded is a message, and the old one stays") {
  tests::ViewerRig rig;
  rig.load("projector");
  rig.settle();
  rig.viewer.open("/nowhere/a.glb");
  rig.runUntil([&] { return !rig.viewer.loader().isLoading(); });
  CHECK_THAT(rig.error(), Catch::Contains("/nowhere/a.glb"));
  CHECK(rig.viewer.state().scene == tests::sceneFile("projector"));
  CHECK(rig.viewer.scene());
  rig.settle();
}

TEST_CASE("a scene that is deleted while it is shown stays, and states of it are saved") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path copy = folder / "deleted.glb";
  std::filesystem::copy_file(tests::sceneFile("projector"), copy);
  tests::ViewerRig rig;
  rig.viewer.open(copy);
  rig.runUntil([&] { return !rig.viewer.loader().isLoading(); });
  std::filesystem::remove(copy);
  rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.1, 0));
  rig.settle();
  CHECK(rig.error().empty());
  const std::filesystem::path file = folder / "deleted.json";
  rig.viewer.saveState(file);
  CHECK(rig.error().empty());
  rig.viewer.openState(file); // of the scene that is there
  CHECK(rig.error().empty());
  CHECK_FALSE(rig.viewer.loader().isLoading());
}

TEST_CASE("the window lives while a picture takes long, and what it changes ends that picture") {
  tests::ViewerRig rig(640, 360);
  rig.load("projector");
  rig.settle();
  settings::State state = rig.viewer.state();
  state.settings.technique = tyndall::Technique::Exact;
  int turns = 0;
  rig.viewer.whileDrawing = [&] {
    CHECK(rig.viewer.isDrawing());
    ++turns;
  };
  rig.viewer.edit("technique", state);
  rig.settle();
  CHECK(rig.viewer.isSettled());
  CHECK(rig.viewer.first().statistics().marchedSamples == 640 * 360);
  CHECK(turns > 3);
  const std::vector<float> exact = host::readColour(rig.viewer.first().inscatter(), 640, 360);

  bool hasTurned = false;
  int drawn = 0;
  rig.viewer.whileDrawing = [&] {
    if (!hasTurned) rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.1, 0));
    hasTurned = true;
  };
  rig.viewer.edit("technique", state);
  rig.runUntil([&] { return hasTurned; });
  CHECK_FALSE(rig.viewer.isSettled());
  rig.step();
  CHECK(rig.last == Activity::Drew); // the turned view, coarse
  drawn = rig.settle();
  CHECK(drawn >= 1);
  rig.viewer.whileDrawing = {};
  rig.viewer.setView(viewer::orbited(rig.viewer.view(), -0.1, 0));
  rig.settle();
  const std::vector<float> again = host::readColour(rig.viewer.first().inscatter(), 640, 360);
  double most = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    most = std::max<double>(most, std::abs(exact[i] - again[i]));
  CHECK(most < 1e-3); // but for the rounding of the turns
}

TEST_CASE("two ways are drawn beside each other, each with its error") {
  tests::ViewerRig rig;
  rig.load("projector");
  settings::State state = rig.viewer.state();
  state.compared.emplace();
  rig.viewer.edit("compared", state);
  rig.viewer.measuresErrors = true;
  rig.viewer.setWipe(0.5F);
  rig.settle();
  REQUIRE(rig.viewer.second());
  REQUIRE(rig.viewer.meter().errors().size() == 2);
  CHECK(rig.viewer.meter().errors()[0].rRmse < rig.viewer.meter().errors()[1].rRmse);
  rig.viewer.undo();
  rig.settle();
  CHECK_FALSE(rig.viewer.second());
  CHECK(rig.viewer.meter().errors().size() == 1);
}

TEST_CASE("a camera's path is recorded, kept in the state, and taken again") {
  tests::ViewerRig rig(32, 18);
  rig.load("projector");
  rig.settle();
  const viewer::LookAt start = rig.viewer.view();
  rig.viewer.record(true);
  std::vector<viewer::LookAt> views;
  for (int i = 0; i < 50; ++i) {
    rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.02, 0));
    views.push_back(rig.viewer.view());
    rig.step();
  }
  rig.viewer.record(false);
  const std::vector<settings::PathPoint>& path = rig.viewer.state().path;
  REQUIRE(path.size() > 10);
  CHECK(path.back().seconds == Approx(1).margin(0.06));
  CHECK(path.front().view.eye == start.eye);
  CHECK(rig.viewer.history().nameOfUndo() == "record path");

  rig.viewer.setView(start);
  rig.viewer.playback.loops = false;
  rig.viewer.playPath(true);
  double apart = 0;
  for (int i = 0; i < 45; ++i) {
    rig.step();
    CHECK(rig.viewer.isOnPath());
    apart = std::max(apart, glm::length(rig.viewer.view().eye - views[static_cast<std::size_t>(i)].eye));
  }
  CHECK(apart < 0.05 * glm::length(start.eye - start.target));
  rig.runUntil([&] { return !rig.viewer.isOnPath(); });
  CHECK(glm::length(rig.viewer.view().eye - path.back().view.eye) < 1e-9);
  rig.viewer.playPath(true);
  rig.step();
  rig.viewer.setView(start); // whoever moves the camera has it
  CHECK_FALSE(rig.viewer.isOnPath());
}

TEST_CASE("a path may rest, and a scene's camera leaves it") {
  tests::ViewerRig rig(32, 18);
  rig.load("projector");
  rig.settle();
  rig.viewer.record(true);
  rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.2, 0));
  rig.step();
  for (int i = 0; i < 10; ++i) {
    rig.viewer.update(rig.now += 3); // as a window that waits
    CHECK(rig.viewer.isRecording());
  }
  rig.viewer.record(false);
  CHECK(rig.viewer.state().path.back().seconds > 29);
  rig.viewer.playPath(true);
  rig.step();
  rig.viewer.useSceneCamera(0);
  CHECK_FALSE(rig.viewer.isOnPath());
  CHECK(rig.viewer.state().camera == 0);
}

TEST_CASE("a light may become one of any kind, whatever its fields are") {
  tests::ViewerRig rig;
  rig.load("projector");
  settings::State state = rig.viewer.state();
  state.lights.emplace(1);
  tyndall::Light& light = state.lights->front().light;
  light.position = {0, 2, 0};
  light.direction = {0.1, -1, 0.2};
  light.colour = {3, 3, 3};
  light.cascadeFade = 0.2F;
  light.boundary.enabled = true;
  for (const auto kind : {tyndall::LightKind::Directional, tyndall::LightKind::Spot, tyndall::LightKind::Point}) {
    CAPTURE(static_cast<int>(kind));
    light.kind = kind;
    rig.viewer.edit("kind", state);
    rig.settle();
    CHECK(rig.error().empty());
  }
}

TEST_CASE("what would take all of a machine's memory is refused, and the picture stays") {
  tests::ViewerRig rig(1500, 1000);
  rig.load("projector");
  rig.runUntil([&] { return rig.last == Activity::Drew; });
  const settings::State start = rig.viewer.state();
  const auto refusalOf = [&](const settings::State& state) {
    rig.viewer.edit("large", state);
    rig.runUntil([&] { return rig.last == Activity::Idle; });
    const std::string error = rig.error();
    rig.viewer.undo();
    return error;
  };
  settings::State state = start;
  state.supersample = 8;
  CHECK_THAT(refusalOf(state), Catch::Contains("picture.supersample, msaa: 12000x8000 with 1 samples a pixel"));
  state = start;
  state.lights.emplace(16);
  for (settings::StateLight& light : *state.lights) {
    light.light.kind = tyndall::LightKind::Point;
    light.light.position = {0, 1, 0};
  }
  state.shadowSize = 16384;
  CHECK_THAT(refusalOf(state), Catch::Contains("maps.shadowSize: 16384 makes "));
  CHECK(rig.viewer.first().width() > 0);
}

TEST_CASE("an animation plays and can be stopped") {
  tests::ViewerRig rig;
  rig.load("pendulum");
  CHECK(rig.viewer.duration() > 0);
  rig.viewer.playback.isPlaying = true;
  for (int i = 0; i < 10; ++i)
    rig.step();
  const double seconds = rig.viewer.state().seconds;
  CHECK(seconds > 0.1);
  rig.viewer.playback.isPlaying = false;
  rig.settle();
  CHECK(rig.viewer.state().seconds == seconds);
}

TEST_CASE("a state that contradicts itself is not taken") {
  tests::ViewerRig rig;
  rig.load("projector");
  settings::State state = rig.viewer.state();
  state.lights.emplace(1);
  (*state.lights)[0].light.innerConeAngle = 1;
  rig.viewer.edit("cone", state);
  CHECK_THAT(rig.error(), Catch::Contains("lights[0].innerConeAngle: 1 must not exceed outerConeAngle"));
  CHECK_FALSE(rig.viewer.state().lights);
}

TEST_CASE("a frame that the effect refuses is a message once, and the next edit is drawn") {
  tests::ViewerRig rig;
  rig.load("projector");
  settings::State state = rig.viewer.state();
  state.settings.technique = tyndall::Technique::Tree;
  state.settings.debugView = tyndall::DebugView::Samples; // of epipolar
  rig.viewer.edit("view", state);
  rig.runUntil([&] { return rig.last == Activity::Idle; });
  CHECK_THAT(rig.error(), Catch::Contains("settings.debugView"));
  rig.step();
  CHECK(rig.error().empty());
  rig.viewer.undo();
  rig.settle();
  CHECK(rig.error().empty());
}

TEST_CASE("a camera that the scene does not have is a message, and the view can be moved on") {
  tests::ViewerRig rig;
  rig.load("projector");
  rig.settle();
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "camera.json";
  settings::State state = rig.viewer.state();
  state.camera = 77;
  settings::saveState(file, state);
  rig.viewer.openState(file);
  rig.runUntil([&] { return rig.last == Activity::Idle; });
  CHECK_THAT(rig.error(), Catch::Contains("camera"));
  rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.1, 0));
  rig.settle();
  CHECK(rig.error().empty());
}

TEST_CASE("samples of a pixel may be any number that is offered") {
  tests::ViewerRig rig;
  rig.load("projector");
  for (const int samples : {2, 4, 8, 1}) {
    CAPTURE(samples);
    settings::State state = rig.viewer.state();
    state.msaa = samples;
    rig.viewer.edit("msaa", state);
    if (samples > host::mostSamples()) {
      const GLuint before = rig.viewer.picture();
      rig.runUntil([&] { return rig.last == Activity::Idle; });
      CHECK(rig.error().find("msaa") != std::string::npos);
      CHECK(rig.viewer.picture() == before);
      continue;
    }
    rig.settle();
    CHECK(rig.error().empty());
    CHECK(rig.viewer.surfaces().multisampled() == (samples > 1));
    CHECK(rig.viewer.pixelAt(0.5, 0.5).distance > 0);
  }
}

TEST_CASE("any setting may be changed at any time", "[pictures]") {
  tests::ViewerRig rig(64, 36);
  rig.load("projector");
  std::mt19937 random(11);
  for (int i = 0; i < 150; ++i) {
    settings::State state = rig.viewer.state();
    settings::visitTables(state, [&](const std::string& name, auto& part, const auto& table) {
      if (name == "picture" || name == "maps") return; // of any size
      const std::size_t index = random() % table.rows.size();
      if (random() % 3 == 0) table.rows[index].set(part, tests::randomValue(table.rows[index], random));
    });
    if (random() % 4 == 0) rig.viewer.setView(viewer::orbited(rig.viewer.view(), 0.3, 0.1));
    rig.viewer.edit("edit " + std::to_string(i), state);
    if (random() % 5 == 0) rig.viewer.undo();
    rig.step();
    if (random() % 4 == 0) rig.runUntil([&] { return rig.last == Activity::Idle; });
    const std::string error = rig.error();
    CAPTURE(i, error);
    CHECK((error.empty() || error.find("settings.debugView") != std::string::npos));
  }
}
