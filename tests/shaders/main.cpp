// tyndall-shaders DIR: writes every shader of the project as a complete source, for compilers that read files.
#include "ShaderSet.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <render/OptionRules.h>

namespace {

void write(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::size_t count = 0;
  for (const auto& [name, text] : tests::allShaders()) {
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
    app.add_option("DIR", folder, "the folder, which is made")->required();
    render::parseArguments(app, argc, argv);
    write(folder);
    return 0;
  });
}
