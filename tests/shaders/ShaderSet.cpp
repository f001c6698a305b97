#include "ShaderSet.h"

#include "avsm/Programs.h"
#include "baselines/ShaderText.h"
#include "plan/Passes.h"
#include "support/PublicShaders.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

using namespace tyndall;

namespace tests {

namespace {

// The values of definitions that have more to say than their names.
const std::map<std::string, std::vector<std::string>> kWords = {
    {"LIGHT_KIND", {"directional", "point", "spot"}},
    {"SHADOW_VIEWS", {"no-map", "one-view", "views"}},
    {"MONOCHROME", {"rgb", "grey"}},
    {"FILTER_BILINEAR", {"nearest", "bilinear"}},
    {"SHADOW_ARRAY", {"", "array"}},
    {"SOURCE", {"texture", "array", "cube", "cube-array"}},
    {"EXITS", {"entries", "exits"}},
};

std::string wordOf(const std::string& name, int value) {
  const auto found = kWords.find(name);
  if (found != kWords.end()) return found->second.at(static_cast<std::size_t>(value));
  if (value == 0) return {};
  std::string word;
  const std::size_t prefix = name.rfind("TYNDALL_", 0) == 0 ? 8 : 0;
  std::transform(name.begin() + static_cast<std::ptrdiff_t>(prefix), name.end(), std::back_inserter(word),
                 [](unsigned char c) { return c == '_' ? '-' : static_cast<char>(std::tolower(c)); });
  return value == 1 ? word : word + "-" + std::to_string(value);
}

class Collector {
public:
  explicit Collector(gl::Language language = gl::Language::Glsl) : language_(language) {}

  void add(const std::string& name, const std::string& text) {
    if (texts_.insert(text).second) files_.push_back({name, text});
  }

  // A shader of glsl/passes, named after those of the definitions that it mentions.
  void addPass(const std::string& file, const gl::Definitions& definitions) {
    const std::filesystem::path path(file);
    const std::string text = gl::completeSource(file, definitions, language_);
    add(nameInWords(path.stem(), gl::mentionedBy(text, definitions)) + path.extension().string(), text);
  }

  std::vector<ShaderFile> take() { return std::move(files_); }

private:
  gl::Language language_;
  std::set<std::string> texts_;
  std::vector<ShaderFile> files_;
};

void addPrograms(const std::vector<gl::Variant>& programs, Collector& all) {
  for (const gl::Variant& program : programs) {
    all.addPass(program.fragment, program.definitions);
    if (!program.vertex.empty()) all.addPass(program.vertex, program.definitions);
  }
}

// The reference compiler knows one extension for OpenGL ES only, and the other from GLSL 4.50 on.
bool isKnownToReference(const PublicShader& shader) {
  return shader.needs.empty() || (shader.needs == "GL_ARB_fragment_shader_interlock" && shader.version >= 45);
}

void addPublic(const std::vector<PublicShader>& shaders, Collector& all) {
  for (const PublicShader& shader : shaders)
    if (isKnownToReference(shader)) all.add(shader.name + "." + shader.extension, shader.text);
}

// One or more views, as the light has them; glass; both destinations.
std::vector<gl::Definitions> baselineDefinitions() {
  std::vector<gl::Definitions> all;
  for (int kind = 0; kind < 3; ++kind)
    for (int bits = 0; bits < 32; ++bits)
      all.push_back({{"LIGHT_KIND", kind},
                     {"SHADOW_VIEWS", kind == 2 ? 1 : 1 + (bits & 1)},
                     {"SHADOW_ARRAY", bits & 1},
                     {"GLASS", bits >> 1 & 1},
                     {"COMPOSITE", bits >> 2 & 1},
                     {"BOUNDARY", kind == 0 ? bits >> 3 & 1 : 0},
                     {"FACES", bits >> 3 & 1},
                     {"CAP", bits >> 4 & 1},
                     {"MONOCHROME", bits >> 4 & 1},
                     {"FILTER_BILINEAR", 0},
                     {"DEPTH_MULTISAMPLED", 0}});
  return all;
}

// All but floor.frag, whose fetches are put together for a pass that was measured.
void addBaselines(Collector& all) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(TYNDALL_BASELINE_SHADERS))
    files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    if ((file.extension() != ".frag" && file.extension() != ".vert") || file == "floor.frag") continue;
    const std::string text = bench::shaderText(file.string());
    for (const gl::Definitions& definitions : baselineDefinitions()) {
      const gl::Definitions mentioned = gl::mentionedBy(text, definitions);
      std::string lines;
      for (const auto& [name, value] : mentioned)
        lines += "#define " + name + " " + std::to_string(value) + "\n";
      const std::size_t afterVersion = text.find('\n') + 1;
      all.add("baseline-" + nameInWords(file.stem(), mentioned) + file.extension().string(),
              std::string(text).insert(afterVersion, lines));
    }
  }
}

} // namespace

std::string nameInWords(const std::string& stem, const gl::Definitions& definitions) {
  std::string name = stem;
  for (const auto& [definition, value] : definitions)
    if (const std::string word = wordOf(definition, value); !word.empty()) name += "-" + word;
  return name;
}

std::vector<ShaderFile> allShaders() {
  Collector all;
  addPrograms(allVariants(), all);
  addPrograms(avsm::allVariants(), all);
  for (const auto& shaders : {captureShaders(), insertShaders(), lookupShaders(), shaftsLookupShaders()})
    addPublic(shaders, all);
  addBaselines(all);
  return all.take();
}

std::vector<ShaderFile> embeddedShaders() {
  Collector all(gl::Language::Essl);
  for (const bool dualSource : {true, false})
    addPrograms(allVariants(dualSource), all);
  return all.take();
}

} // namespace tests
