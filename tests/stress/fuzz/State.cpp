// State files. What is accepted is what it was once it has been written and read back, and what tyndall-render begins
// with when it is told the state as a command.
#include "CheckFrame.h"
#include "Fuzz.h"
#include "render/Options.h"
#include "settings/RandomState.h"

#include <scene/Error.h>
#include <settings/CodeText.h>
#include <settings/CommandText.h>
#include <settings/StateFile.h>

namespace {

void requireSame(const settings::State& a, const settings::State& b, const std::string& way) {
  for (const std::string& field : tests::differences(a, b))
    fuzz::require(false, way + " keeps " + field);
}

void requireRules(const settings::State& state) {
  tyndall::Frame frame;
  frame.viewport = {0, 0, settings::renderedWidth(state), settings::renderedHeight(state)};
  frame.colour = 1;
  frame.camera.clipFromView = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0};
  frame.settings = state.settings;
  frame.settings.debugView = tyndall::DebugView::Composite; // which asks for other settings
  frame.reuse = state.reuse;
  if (state.medium) frame.medium = *state.medium;
  if (state.lights) frame.lights = settings::lightsOf(*state.lights, {});
  for (tyndall::Light& light : frame.lights)
    light.boundary.enabled = false; // to which the light may be parallel
  const tyndall::Status status = tyndall::checkValues(frame);
  // Which no field can tell by itself.
  const bool isOfRange = status.message.find("32-bit floats, relative to the eye") != std::string::npos;
  fuzz::require(status || isOfRange, "the effect takes the state: " + status.message);
  fuzz::require(!settings::codeOf(frame, state.tuning).empty(), "a state has code");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path folder = "/folder";
  fuzz::accepts<host::Error>([&] {
    settings::State state = settings::parseState(fuzz::textOf(data, size), "state.json", folder);
    const std::string text = settings::textOf(state, folder);
    requireSame(state, settings::parseState(text, "written.json", folder), "writing");
    requireRules(state);
    fuzz::require(!settings::commandOf(state).empty(), "a state has a command");
  });
  fuzz::accepts<host::Error>([&] {
    const std::string text = settings::textOf(settings::parseLights(fuzz::textOf(data, size), "--lights"));
    fuzz::require(settings::textOf(settings::parseLights(text, "--lights")) == text, "lights are read back: " + text);
  });
  return 0;
}
