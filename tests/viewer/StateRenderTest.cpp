// A state draws one picture: from a file, from a command, in the viewer.
#include "ViewerRig.h"
#include "reference/Metrics.h"

#include <gl/ReadBack.h>
#include <random>
#include <render/RenderFrame.h>
#include <settings/CommandText.h>
#include <settings/StateFile.h>

namespace {

/// Of words without blanks in them, but for those in quotes.
std::vector<std::string> wordsOf(const std::string& command) {
  std::vector<std::string> words(1);
  bool isQuoted = false;
  for (const char c : command)
    if (c == '\'')
      isQuoted = !isQuoted;
    else if (c == ' ' && !isQuoted)
      words.emplace_back();
    else
      words.back() += c;
  return words;
}

render::Options parsed(const std::vector<std::string>& words) {
  std::vector<const char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(word.c_str());
  render::Options options = render::parseOptions(static_cast<int>(arguments.size()), arguments.data());
  options.context = tests::testContextKind();
  options.programs.reset();
  return options;
}

render::Picture rendered(const render::Options& options) {
  render::Picture picture;
  {
    render::FrameRenderer renderer(options);
    renderer.render(0);
    picture = renderer.readPicture();
  }
  tests::testContext().makeCurrent();
  return picture;
}

/// The largest difference of all channels, over the mean of the second.
double differenceOf(const std::vector<float>& a, const std::vector<float>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max<double>(largest, std::abs(static_cast<double>(a[i]) - b[i]));
    sum += std::abs(b[i]);
  }
  REQUIRE(sum > 0);
  return largest * static_cast<double>(a.size()) / sum;
}

/// With something of everything that has an own form.
settings::State stateOf(const std::string& scene) {
  settings::State state;
  state.scene = tests::sceneFile(scene);
  state.width = 96;
  state.height = 54;
  state.shadowSize = 256;
  state.seconds = 0.25;
  state.profile = tyndall::Profile::Balanced;
  state.settings = tyndall::settingsOf(state.profile);
  state.settings.slices = 301;
  state.settings.shadowFilter = tyndall::ShadowFilter::Bilinear;
  return state;
}

settings::State editedState() {
  settings::State state = stateOf("sweep");
  state.medium.emplace();
  state.medium->constituents = {{{0.02F, 0.03F, 0.04F}, tyndall::Phase::HenyeyGreenstein, 0.6F},
                                {{0.01F, 0.01F, 0.01F}, tyndall::Phase::Rayleigh, 0}};
  state.lights.emplace(3);
  (*state.lights)[0].light.kind = tyndall::LightKind::Spot;
  (*state.lights)[0].follows = 1;
  (*state.lights)[0].light.colour = {40, 20, 10};
  (*state.lights)[1].on = false;
  (*state.lights)[2].light.kind = tyndall::LightKind::Point;
  (*state.lights)[2].light.position = {0.3, 2.7, 0.1};
  (*state.lights)[2].light.colour = {3, 7, 9};
  return state;
}

void checkOnePicture(const settings::State& state) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "state.json";
  settings::saveState(file, state);
  const render::Picture byFile = rendered(parsed({"tyndall-render", "--state", file.string()}));
  const std::string command = settings::commandOf(state);
  CAPTURE(command);
  const render::Picture byCommand = rendered(parsed(wordsOf(command)));
  CHECK(differenceOf(byFile.composite, byCommand.composite) < 1e-6);
  CHECK(differenceOf(byFile.inscatter, byCommand.inscatter) < 1e-6);

  tests::ViewerRig rig(state.width, state.height);
  rig.viewer.openState(file);
  rig.runUntil([&] { return !rig.viewer.loader().isLoading(); });
  CHECK(rig.error().empty());
  rig.settle();
  const viewer::Way& shown = rig.viewer.first();
  REQUIRE(shown.width() == state.width);
  CHECK(differenceOf(host::readColour(shown.composite(), state.width, state.height), byFile.composite) < 1e-6);
  CHECK(differenceOf(host::readColour(shown.inscatter(), state.width, state.height), byFile.inscatter) < 1e-6);
}

} // namespace

TEST_CASE("a state's picture is the same by --state, by its command, and in the viewer") {
  checkOnePicture(stateOf("projector"));
}

TEST_CASE("so it is with a medium and lights of one's own") { checkOnePicture(editedState()); }

TEST_CASE("so it is by another technique, from another place, in several cascades", "[pictures]") {
  settings::State state = stateOf("nave");
  state.lookAt = settings::LookAt{{0.5, 2, 9}, {0.1, 3, -4}, 71};
  state.settings.technique = tyndall::Technique::Tree;
  state.cascades = 3;
  state.cascadeFade = 0.2;
  checkOnePicture(state);
}

TEST_CASE("whatever was done before, the picture at rest is that of the state which is saved then", "[pictures]") {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "state.json";
  for (const char* scene : {"stage", "nave"}) {
    CAPTURE(scene);
    tests::ViewerRig rig(160, 90);
    rig.load(scene);
    settings::State fast = rig.viewer.state();
    fast.profile = tyndall::Profile::Performance;
    fast.settings = tyndall::settingsOf(fast.profile);
    rig.viewer.edit("profile", fast);
    rig.settle();
    std::mt19937 random(5);
    for (int i = 0; i < 6; ++i) {
      CAPTURE(i);
      const double turn = std::uniform_real_distribution<double>(-0.2, 0.2)(random);
      rig.viewer.setView(viewer::orbited(rig.viewer.view(), turn, 0.1 * turn));
      if (i % 2 == 0) rig.step();
      settings::State state = rig.viewer.state();
      state.settings.breakThreshold *= 2;
      state.lights = settings::following(rig.viewer.first().frame().lights);
      state.lights->back().follows = -1;
      state.lights->back().light.position[0] += 0.2;
      rig.viewer.edit("light and threshold", state);
      if (i % 3 == 0) rig.settle();
      rig.viewer.undo();
      rig.settle();
      settings::saveState(file, rig.viewer.state());
      const render::Picture fresh = rendered(parsed({"tyndall-render", "--state", file.string()}));
      CHECK(differenceOf(host::readColour(rig.viewer.first().composite(), 160, 90), fresh.composite) < 1e-6);
      CHECK(differenceOf(host::readColour(rig.viewer.first().inscatter(), 160, 90), fresh.inscatter) < 1e-6);
    }
  }
}
