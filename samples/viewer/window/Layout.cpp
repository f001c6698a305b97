#include "Layout.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <scene/Json.h>

namespace viewer {

namespace {

std::optional<std::filesystem::path> layoutFile() {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  if (config && *config) return std::filesystem::path(config) / "tyndall/viewer.json";
  if (home && *home) return std::filesystem::path(home) / ".config/tyndall/viewer.json";
  return std::nullopt;
}

} // namespace

Layout loadLayout() {
  constexpr int kLeast = 160, kMost = 8192;
  Layout layout;
  const auto file = layoutFile();
  std::error_code error;
  if (!file || !std::filesystem::exists(*file, error)) return layout;
  try {
    const std::vector<std::uint8_t> text = host::readFile(*file, 1 << 16);
    const nlohmann::json json = host::parseJson<nlohmann::json>(host::textOf(text));
    layout.width = std::clamp(json.value("width", layout.width), kLeast, kMost);
    layout.height = std::clamp(json.value("height", layout.height), kLeast, kMost);
    layout.showsPanel = json.value("panel", layout.showsPanel);
  } catch (const std::exception&) {
    return {};
  }
  return layout;
}

void saveLayout(const Layout& layout) {
  const auto file = layoutFile();
  if (!file) return;
  std::error_code error;
  std::filesystem::create_directories(file->parent_path(), error);
  const nlohmann::json json = {{"width", layout.width}, {"height", layout.height}, {"panel", layout.showsPanel}};
  try {
    host::writeText(*file, json.dump() + "\n");
  } catch (const host::Error&) {
    return; // it is no reason to say anything at the end
  }
}

} // namespace viewer
