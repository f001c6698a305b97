// What is taken home: pictures and states as files, and the picture on the screen.
#include "../settings/RandomState.h"
#include "ViewerRig.h"

#include <algorithm>
#include <fstream>
#include <gl/ReadBack.h>
#include <scene/Error.h>
#include <scene/ImageFile.h>
#include <settings/StateFile.h>
#include <settings/Tables.h>

TEST_CASE("a picture is saved as tyndall-render draws its state, differences and what has just been lit, too") {
  const tests::TemporaryFolder folder;
  tests::ViewerRig rig;
  rig.load("projector");
  rig.settle();
  settings::State state = rig.viewer.state();
  state.settings.debugView = tyndall::DebugView::Difference;
  rig.viewer.edit("view", state);
  rig.settle();
  rig.viewer.savePicture(folder / "difference.exr");
  CHECK(rig.error().empty());
  const host::Image image = host::readExr(folder / "difference.exr");
  const std::vector<float>& red = *image.find("R");
  const auto grey = std::count_if(red.begin(), red.end(), [](float r) { return std::abs(r - 0.5F) < 0.3F; });
  CHECK(static_cast<double>(grey) > 0.8 * static_cast<double>(red.size())); // the composite is mostly dark
  rig.viewer.undo();
  rig.settle();
  const double stops = rig.viewer.exposureStops();
  state = rig.viewer.state();
  state.lights = settings::following(rig.viewer.first().frame().lights);
  for (settings::StateLight& light : *state.lights)
    for (float& channel : light.light.colour)
      channel *= 64;
  rig.viewer.edit("light", state);
  rig.viewer.savePicture(folder / "bright.png"); // before it is drawn
  CHECK(rig.viewer.exposureStops() < stops - 3);
}

TEST_CASE("no state and no picture is written over what the scene is read from") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path scene = folder / "scene.json"; // which a glTF may be called
  std::filesystem::copy_file(tests::sceneFile("projector"), scene);
  tests::ViewerRig rig;
  rig.viewer.open(scene);
  rig.runUntil([&] { return !rig.viewer.loader().isLoading(); });
  REQUIRE(rig.viewer.scene());
  static_cast<void>(rig.error());
  rig.viewer.saveState(scene);
  CHECK_THAT(rig.error(), Catch::Contains("is a file of the scene"));
  CHECK(std::filesystem::file_size(scene) == std::filesystem::file_size(tests::sceneFile("projector")));
  rig.viewer.saveState(folder / "state");
  CHECK_THAT(rig.error(), Catch::Contains("a state's name must end in .json"));
}

TEST_CASE("a state for the scene that is shown is checked as one for another is") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "camera.json";
  tests::ViewerRig rig;
  rig.load("projector");
  rig.settle();
  const settings::State before = rig.viewer.state();
  std::ofstream(file) << R"({"version": 1, "camera": {"scene": 99}})";
  rig.viewer.openState(file);
  CHECK_THAT(rig.error(), Catch::Contains("camera 99 is not there"));
  CHECK(tests::differences(rig.viewer.state(), before) == std::vector<std::string>());
}

TEST_CASE("what is shown is what host::toneMap makes of the picture") {
  tests::ViewerRig rig;
  rig.load("projector");
  for (const host::Tone tone : {host::Tone::Film, host::Tone::Reinhard, host::Tone::Clip}) {
    settings::State state = rig.viewer.state();
    state.exposureStops = -1;
    state.tone = tone;
    rig.viewer.edit("tone", state);
    rig.settle();
    const std::vector<float> shown = host::readColour(rig.viewer.picture(), 96, 54, 3);
    const std::vector<float> radiance = host::readColour(rig.viewer.first().composite(), 96, 54, 3);
    const std::vector<std::uint8_t> wanted = host::toneMap(radiance.data(), 96, 54, 0.5F, 1, tone);
    float largest = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      largest = std::max(largest, std::abs(255 * shown[i] - static_cast<float>(wanted[i])));
    CAPTURE(static_cast<int>(tone));
    CHECK(largest <= 1.01F);
  }
}

TEST_CASE("pictures are saved as they are shown") {
  const tests::TemporaryFolder folder;
  tests::ViewerRig rig;
  rig.load("projector");
  rig.viewer.savePicture(folder / "saved.exr");
  CHECK(rig.error().empty());
  const host::Image image = host::readExr(folder / "saved.exr");
  CHECK(image.width == 96);
  CHECK(image.find("inscatter.R"));
  rig.viewer.savePicture(folder / "saved.png");
  CHECK(host::isWholePng(folder / "saved.png", 96, 54));
  rig.viewer.savePicture(folder / "saved.jpg");
  CHECK_THAT(rig.error(), Catch::Contains("must end in .exr or .png"));
  rig.viewer.savePicture("/proc/a.png");
  CHECK_THAT(rig.error(), Catch::Contains("/proc/a.png"));
  rig.settle();
}
