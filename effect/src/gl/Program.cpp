#include "gl/Program.h"

#include "gl/Enums.h"
#include "gl/ShaderSources.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>

namespace tyndall::gl {

namespace {

struct Sampler {
  const char* name;
  Unit unit;
};
constexpr Sampler kSamplers[] = {
    {"sceneDepth", Unit::SceneDepth},
    {"shadowMap", Unit::ShadowMap},
    {"glassColour", Unit::GlassColour},
    {"glassDepth", Unit::GlassDepth},
    {"inscatter", Unit::Inscatter},
    {"transmittance", Unit::Transmittance},
    {"sliceTable", Unit::SliceTable},
    {"sampleEnds", Unit::SampleEnds},
    {"marks", Unit::Marks},
    {"marched", Unit::Marched},
    {"extra", Unit::Extra},
    {"extraGreen", Unit::ExtraGreen},
    {"extraBlue", Unit::ExtraBlue},
    {"epipolarInscatter", Unit::EpipolarInscatter},
    {"lowRankRays", Unit::LowRankRays},
    {"lowRankLights", Unit::LowRankLights},
    {"tintRed", Unit::TintRed},
    {"tintGreen", Unit::TintGreen},
    {"tintBlue", Unit::TintBlue},
    {"coarserRed", Unit::CoarserRed},
    {"coarserGreen", Unit::CoarserGreen},
    {"coarserBlue", Unit::CoarserBlue},
    {"rowDepths", Unit::RowDepths},
    {"rowNodes", Unit::RowNodes},
    {"rowTree", Unit::RowTree},
    {"rowShares", Unit::RowShares},
    {"rowMeans", Unit::RowMeans},
    {"rowMoments", Unit::RowMoments},
    {"rowNodeMeans", Unit::RowNodeMeans},
    {"rowNodeMoments", Unit::RowNodeMoments},
    {"curves", Unit::Curves},
    {"curveCells", Unit::CurveCells},
    {"curveTree", Unit::CurveTree},
    {"extraOffsets", Unit::ExtraOffsets},
    {"sliceSums", Unit::SliceSums},
    {"meanLight", Unit::MeanLight},
    {"changedSlices", Unit::ChangedSlices},
    {"lastSampleEnds", Unit::LastSampleEnds},
    {"changedSegments", Unit::ChangedSegments},
    {"lastRowDepths", Unit::LastRowDepths},
    {"rowHashes", Unit::RowHashes},
    {"lastRowHashes", Unit::LastRowHashes},
    {"changedParts", Unit::ChangedParts},
    {"movedSlices", Unit::MovedSlices},
    {"changedEnds", Unit::ChangedEnds},
    {"changedTiles", Unit::ChangedTiles},
    {"lastDepth", Unit::LastDepth},
    {"image", Unit::ViewImage},
    {"refinedMarks", Unit::ViewImage},
    {"exactInscatter", Unit::ViewExact},
    {"meanInscatter", Unit::ViewMean},
};
constexpr std::array<const char*, 3> kBlocks = {"FrameBlock", "LightBlock", "EpipolarBlock"};

std::string numbered(const std::string& text) {
  std::istringstream lines(text);
  std::string result, line;
  for (int number = 1; std::getline(lines, line); ++number)
    result += std::to_string(number) + ": " + line + "\n";
  return result;
}

std::string keyOf(const std::string& fragment, const Definitions& definitions, const std::string& vertex) {
  std::string key = fragment + " " + vertex;
  for (const auto& [name, value] : definitions)
    key += " " + name + "=" + std::to_string(value);
  return key;
}

bool continuesWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool mentions(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !continuesWord(text[at - 1]);
    if (begins && (end == text.size() || !continuesWord(text[end]))) return true;
  }
  return false;
}

bool isCompute(const std::string& file) { return file.size() > 5 && file.substr(file.size() - 5) == ".comp"; }

} // namespace

Definitions mentionedBy(const std::string& text, const Definitions& definitions) {
  Definitions result;
  std::copy_if(definitions.begin(), definitions.end(), std::back_inserter(result),
               [&](const auto& definition) { return mentions(text, definition.first); });
  return result;
}

Definitions mentioned(const Variant& variant) {
  std::string text = shaderSource(variant.fragment.c_str());
  if (!variant.vertex.empty()) text += shaderSource(variant.vertex.c_str());
  return mentionedBy(text, variant.definitions);
}

std::string completeSource(const std::string& file, const Definitions& definitions) {
  const std::string body = shaderSource(file.c_str());
  std::string text = isCompute(file) ? "#version 430 core\n" : "#version 330 core\n";
  text += "#define UNIFORM_BLOCK(name) layout(std140) uniform name\n";
  for (const auto& [name, value] : mentionedBy(body, definitions))
    text += "#define " + name + " " + std::to_string(value) + "\n";
  return text + body;
}

Uint ProgramCache::use(const std::string& fragment, const Definitions& definitions, const std::string& vertex) {
  const std::string asked = keyOf(fragment, definitions, vertex);
  auto known = names_.find(asked);
  if (known == names_.end()) {
    const Definitions needed = mentioned({fragment, definitions, vertex});
    const std::string key = keyOf(fragment, needed, vertex);
    auto found = programs_.find(key);
    if (found == programs_.end()) {
      const Uint name = link(fragment, needed, vertex);
      if (name == 0) {
        error_ = key + "\n" + error_;
        return 0;
      }
      found = programs_.emplace(key, Program(gl_, name)).first;
    }
    known = names_.emplace(asked, found->second.name()).first;
  }
  gl_.UseProgram(known->second);
  return known->second;
}

Uint ProgramCache::compile(Enum kind, const std::string& file, const Definitions& definitions) {
  const std::string text = completeSource(file, definitions);
  const Char* pointer = text.c_str();
  const Uint shader = gl_.CreateShader(kind);
  gl_.ShaderSource(shader, 1, &pointer, nullptr);
  gl_.CompileShader(shader);
  Int ok = 0, length = 0;
  gl_.GetShaderiv(shader, COMPILE_STATUS, &ok);
  if (ok) return shader;
  gl_.GetShaderiv(shader, INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  gl_.GetShaderInfoLog(shader, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length)); // without its terminating zero
  error_ = log + "\n" + numbered(text);
  gl_.DeleteShader(shader);
  return 0;
}

Uint ProgramCache::link(const std::string& file, const Definitions& definitions, const std::string& vertexFile) {
  if (vertexFile.empty()) {
    const Uint compute = compile(COMPUTE_SHADER, file, definitions);
    return compute ? linkShaders({compute}) : 0;
  }
  const Uint vertex = compile(VERTEX_SHADER, vertexFile, definitions);
  const Uint pixel = vertex ? compile(FRAGMENT_SHADER, file, definitions) : 0;
  if (pixel != 0) return linkShaders({vertex, pixel});
  if (vertex) gl_.DeleteShader(vertex);
  return 0;
}

Uint ProgramCache::linkShaders(const std::vector<Uint>& shaders) {
  const Uint program = gl_.CreateProgram();
  for (const Uint shader : shaders)
    gl_.AttachShader(program, shader);
  gl_.LinkProgram(program);
  for (const Uint shader : shaders) {
    gl_.DetachShader(program, shader);
    gl_.DeleteShader(shader);
  }
  Int ok = 0, length = 0;
  gl_.GetProgramiv(program, LINK_STATUS, &ok);
  if (!ok) {
    gl_.GetProgramiv(program, INFO_LOG_LENGTH, &length);
    error_.assign(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
    gl_.GetProgramInfoLog(program, length, &length, error_.data());
    error_.resize(static_cast<std::size_t>(length));
    gl_.DeleteProgram(program);
    return 0;
  }
  gl_.UseProgram(program);
  for (const Sampler& sampler : kSamplers)
    if (const Int location = gl_.GetUniformLocation(program, sampler.name); location >= 0)
      gl_.Uniform1i(location, static_cast<Int>(sampler.unit));
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    if (const Uint index = gl_.GetUniformBlockIndex(program, kBlocks[i]); index != INVALID_INDEX)
      gl_.UniformBlockBinding(program, index, static_cast<Uint>(i));
  return program;
}

} // namespace tyndall::gl
