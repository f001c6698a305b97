// tyndall-shaders DIR: writes every shader of the project as a complete source, for compilers that read files.
#include "ShaderSet.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

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

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: tyndall-shaders DIR\n");
    return 2;
  }
  try {
    write(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tyndall-shaders: %s: %s\n", arguments[1], error.what());
    return 1;
  }
  return 0;
}
