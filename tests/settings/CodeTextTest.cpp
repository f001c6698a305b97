// Frames as C++ that compiles.
#include "RandomState.h"
#include "support/Catch.h"
#include "support/TemporaryFolder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <settings/CodeText.h>

namespace {

tyndall::Frame frameOf(const settings::State& state) {
  tyndall::Frame frame;
  frame.viewport = {0, 0, 640, 360};
  frame.colour = frame.depth.texture = 1;
  frame.camera.viewFromWorld[12] = 0.1;
  if (state.lights)
    for (const settings::StateLight& light : *state.lights)
      frame.lights.push_back(light.light);
  for (tyndall::Light& light : frame.lights) {
    light.shadow.texture = 3;
    light.shadow.array = true;
    light.shadow.views.resize(2);
    light.shadow.views[1].layer = 1;
    light.shadow.views[1].clipFromWorld[5] = -2;
    light.glass = {4, 5};
  }
  if (state.medium) frame.medium = *state.medium;
  frame.settings = state.settings;
  frame.reuse = state.reuse;
  return frame;
}

/// Whether the project's compiler takes it.
bool compiles(const std::string& code, bool isQuiet = false) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "frame.cpp";
  std::ofstream(file) << code;
  const std::string command = std::string(TYNDALL_COMPILER) + " -std=c++17 -Wall -Wextra -Werror -fsyntax-only -I" +
                              TYNDALL_INCLUDE + " -Wno-unused-function " + file.string() +
                              (isQuiet ? " 2>/dev/null" : "");
  return std::system(command.c_str()) == 0;
}

} // namespace

TEST_CASE("a frame is C++ that compiles") {
  std::string code = settings::codeOf({}, {});
  for (unsigned seed = 0; seed < 12; ++seed) {
    const settings::State state = tests::randomState(seed);
    code +=
        "\nnamespace frame" + std::to_string(seed) + " {\n" + settings::codeOf(frameOf(state), state.tuning) + "}\n";
  }
  CHECK(compiles(code));
  CHECK_FALSE(compiles(code + "oops", true));
}

TEST_CASE("a frame's C++ tells what is not at its default") {
  tyndall::Frame frame;
  frame.viewport = {0, 0, 64, 36};
  frame.settings.technique = tyndall::Technique::Tree;
  frame.settings.breakThreshold = 2;
  frame.medium.constituents.resize(1);
  frame.medium.constituents[0] = {{0.5F, 0.25F, 1}, tyndall::Phase::HenyeyGreenstein, 0.7F};
  frame.lights.resize(1);
  frame.lights[0].range = 3;
  tyndall::Tuning tuning;
  tuning.fixup = tyndall::Masking::Tiles;
  const std::string code = settings::codeOf(frame, tuning);
  for (const char* line : {"  frame.viewport.width = 64;\n", "  frame.settings.technique = tyndall::Technique::Tree;\n",
                           "  frame.settings.breakThreshold = 2.0F;\n", "  frame.medium.constituents.resize(1);\n",
                           "  frame.medium.constituents[0].scattering = {0.5F, 0.25F, 1.0F};\n",
                           "  frame.medium.constituents[0].phase = tyndall::Phase::HenyeyGreenstein;\n",
                           "  frame.medium.constituents[0].g = 0.7F;\n", "  light.range = 3;\n",
                           "  tuning.fixup = tyndall::Masking::Tiles;\n"})
    CHECK_THAT(code, Catch::Contains(line));
  CHECK_THAT(code, !Catch::Contains("slices"));
}
