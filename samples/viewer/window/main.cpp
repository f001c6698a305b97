// tyndall-viewer: scenes, lights, media and settings, to play with.

#include "Window.h"

#include <filesystem>
#include <render/CommandLine.h>
#include <render/OptionRules.h>

namespace {

int run(int argc, char** argv) {
  CLI::App app("Shows a glTF scene with Tyndall's volumetric shadows, and every setting. F1 in the window has help.",
               "tyndall-viewer");
  app.set_version_flag("--version", "tyndall-viewer " TYNDALL_VERSION);
  std::filesystem::path file;
  app.add_option("FILE", file, "a glTF 2.0 file, .glb or .gltf, or a state that was saved, .json");
  bool reports = false;
  app.add_flag(
      "--debug", reports,
      "report on standard error: OpenGL's errors, what the window says of mistakes, and whether it is at rest");
  render::parseArguments(app, argc, argv);
  viewer::Window window(reports);
  return window.run(file) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-viewer", [&] { return run(argc, argv); });
}
