#include "CommandText.h"
#include "StateFile.h"
#include "Tables.h"

#include <fmt/format.h>

namespace settings {

namespace {

std::string placeOf(const glm::dvec3& place) { return fmt::format("{},{},{}", place.x, place.y, place.z); }

std::string cameraOf(const State& state) {
  if (state.lookAt)
    return fmt::format(" --eye={} --target={} --fov {}", placeOf(state.lookAt->eye), placeOf(state.lookAt->target),
                       state.lookAt->fovDegrees);
  return state.camera ? fmt::format(" --camera {}", *state.camera) : "";
}

std::string optionOf(const Row& row, const Value& value) {
  if (row.form != OptionForm::Value) return " " + row.option;
  const std::string text = textOf(row, value);
  return text.front() == '-' ? " " + row.option + "=" + text : " " + row.option + " " + text;
}

/// A state with the profile's settings and everything else at its default.
State startOf(const State& state) {
  State start;
  start.settings = tyndall::settingsOf(state.profile);
  return start;
}

} // namespace

std::string quoted(const std::string& text) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,:=@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string commandOf(const State& state) {
  const std::string scene = state.scene.string();
  std::string command = "tyndall-render " + quoted(scene.rfind('-', 0) == 0 ? "./" + scene : scene);
  command += cameraOf(state) + fmt::format(" --size {}x{}", state.width, state.height);
  if (state.profile != State().profile) command += " --profile " + nameOf(state.profile);
  State start = startOf(state);
  visitTables(start, [&](const char* name, const auto& before, const auto& table) {
    visitTables(state, [&](const char* other, const auto& now, const auto& same) {
      if constexpr (std::is_same_v<decltype(table), decltype(same)>)
        if (std::string(name) == other)
          for (const auto& row : table.rows)
            if (!row.option.empty() && row.get(now) != row.get(before)) command += optionOf(row, row.get(now));
    });
  });
  if (state.medium) command += " --medium " + quoted(textOf(*state.medium));
  if (state.ambient) command += " --ambient " + quoted(textOf(*state.ambient));
  if (state.fog) command += " --fog " + quoted(textOf(*state.fog));
  if (state.lights) command += " --lights " + quoted(textOf(*state.lights));
  return command + " --out picture.png";
}

} // namespace settings
