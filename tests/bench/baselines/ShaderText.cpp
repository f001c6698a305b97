#include "baselines/ShaderText.h"

#include <filesystem>
#include <fstream>
#include <scene/Error.h>
#include <scene/Places.h>
#include <set>
#include <sstream>

namespace bench {

namespace {

std::ifstream openShader(const std::string& file) {
  for (const auto& [inBundle, inBuild] : {std::pair("baselines", TYNDALL_BASELINE_SHADERS),
                                          {"rivals", TYNDALL_RIVAL_SHADERS},
                                          {"glsl", TYNDALL_EFFECT_SHADERS}}) {
    std::ifstream stream(host::placeOf(inBundle, inBuild) / file);
    if (stream) return stream;
  }
  throw host::Error("shader " + file + ": not found");
}

void append(const std::string& file, std::set<std::string>& included, std::string& text) {
  if (!included.insert(file).second) return;
  std::ifstream stream = openShader(file);
  const std::string begin = "#include \"";
  for (std::string line; std::getline(stream, line);)
    if (line.rfind(begin, 0) == 0)
      append(line.substr(begin.size(), line.find('"', begin.size()) - begin.size()), included, text);
    else
      text += line + "\n";
}

} // namespace

std::string shaderText(const std::string& file) {
  return "#version 330 core\n#define UNIFORM_BLOCK(name) layout(std140) uniform name\n" + shaderBody({file});
}

std::string shaderBody(const std::vector<std::string>& files) {
  std::string text;
  std::set<std::string> included;
  for (const std::string& file : files)
    append(file, included, text);
  return text;
}

} // namespace bench
