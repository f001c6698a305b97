// tyndall-make-scenes OUTDIR [NAME...] [--turntable MODEL.glb]: writes the sample scenes as OUTDIR/NAME.glb, or a
// model's own.
#include "Generators.h"
#include "GlbWriter.h"
#include "MeshBuilder.h"
#include <filesystem>
#include <render/OptionRules.h>
#include <scene/Tool.h>

namespace {

void write(scenes::Scene scene, const std::filesystem::path& folder, const std::string& name) {
  scene.name = name;
  scenes::writeGlb(scene, (folder / (name + ".glb")).string());
  host::say(name + ".glb: " + std::to_string(scenes::triangleCount(scene)) + " triangles");
}

void run(const std::string& folder, std::vector<std::string> names) {
  if (names.empty())
    for (const auto& [name, make] : scenes::generators())
      names.push_back(name);
  std::filesystem::create_directories(folder);
  for (const std::string& name : names)
    write(scenes::generators().at(name)(), folder, name);
}

int parseAndRun(int argc, char** argv) {
  CLI::App app("Writes Tyndall's sample scenes.", "tyndall-make-scenes");
  std::string folder, model;
  std::vector<std::string> names;
  std::vector<std::string> known;
  for (const auto& [name, make] : scenes::generators())
    known.push_back(name);
  app.add_option("OUTDIR", folder, "folder of the .glb files")->required();
  app.add_option("--turntable", model,
                 "a glTF file: writes its model turning in a box with a lamp, as OUTDIR/turntable-NAME.glb")
      ->check(CLI::ExistingFile);
  app.add_option("NAME", names, "scenes to write; all if none is named")->check(CLI::IsMember(known));
  render::parseArguments(app, argc, argv);
  if (!model.empty()) {
    std::filesystem::create_directories(folder);
    write(scenes::makeTurntable(model), folder, "turntable-" + std::filesystem::path(model).stem().string());
  }
  if (model.empty() || !names.empty()) run(folder, names);
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-make-scenes", [&] { return parseAndRun(argc, argv); });
}
