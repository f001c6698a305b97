// tyndall-shaders [--essl] DIR: writes every shader of the project, or those of the effect as OpenGL ES is given them,
// as a complete source, for compilers that read files.
#include "ShaderSet.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <render/OptionRules.h>

namespace {

void write(const std::filesystem::path& folder, const std::vector<tests::ShaderFile>& files) {
  std::filesystem::create_directories(folder);
  std::size_t count = 0;
  for (const auto& [name, text] : files) {
    std::ofstream file(folder / name);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file << text;
    file.close();
    ++count;
  }
  std::printf("%zu shaders in %s\n", count, folder.string().c_str());
}

} // namespace

int main(int argc, char** argv) {
  return render::runCommand("tyndall-shaders", [&] {
    std::filesystem::path folder;
    CLI::App app("Writes every shader of the project as a complete source.", "tyndall-shaders");
    bool essl = false;
    app.add_flag("--essl", essl, "the effect's, as OpenGL ES is given them");
    app.add_option("DIR", folder, "the folder, which is made")->required();
    render::parseArguments(app, argc, argv);
    write(folder, essl ? tests::embeddedShaders() : tests::allShaders());
    return 0;
  });
}
