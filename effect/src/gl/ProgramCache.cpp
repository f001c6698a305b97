#include "gl/ProgramCache.h"

#include "gl/Enums.h"
#include "gl/Label.h"

#include <optional>
#include <sstream>

namespace tyndall::gl {

namespace {

std::string numbered(const std::string& text) {
  std::istringstream lines(text);
  std::string result, line;
  for (int number = 1; std::getline(lines, line); ++number)
    result += std::to_string(number) + ": " + line + "\n";
  return result;
}

// Of a shader or a program.
template <typename Get, typename GetLog>
std::string logOf(Uint object, Get get, GetLog getLog) {
  Int length = 0;
  get(object, INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  getLog(object, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length)); // without its terminating zero
  return log;
}

std::vector<std::string> textsOf(const Variant& variant, Language language) {
  std::vector<std::string> texts;
  for (const std::string& file : {variant.fragment, variant.vertex})
    if (!file.empty()) texts.push_back(completeSource(file, variant.definitions, language));
  return texts;
}

} // namespace

/// Being compiled from its construction on; deleted when no program that is being built has it.
class ProgramCache::Shader {
public:
  Shader(const Functions& gl, Enum kind, std::string text)
      : gl_(gl), name_(gl.CreateShader(kind)), text_(std::move(text)) {
    const Char* pointer = text_.c_str();
    gl.ShaderSource(name_, 1, &pointer, nullptr);
    gl.CompileShader(name_);
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { gl_.DeleteShader(name_); }

  Uint name() const { return name_; }

  /// Why it does not compile, and its text; empty if it does. Waits for it.
  std::string failure() const {
    Int ok = 0;
    gl_.GetShaderiv(name_, COMPILE_STATUS, &ok);
    if (ok) return {};
    return logOf(name_, gl_.GetShaderiv, gl_.GetShaderInfoLog) + "\n" + numbered(text_);
  }

private:
  const Functions& gl_;
  Uint name_;
  std::string text_;
};

/// A program and how far it is.
struct ProgramCache::Build {
  enum class State { Idle, Started, Failed, Built };

  Variant variant; // with what its shaders mention
  State state = State::Idle;
  ProgramObject program;              // while it is started
  std::vector<ShaderPointer> shaders; // attached to it; none: it came from the store
  std::string storeKey;
  std::string log;
  std::optional<Program> built;
};

ProgramCache::ProgramCache(const Functions& gl, ProgramStore store) : gl_(gl), binaries_(gl, std::move(store)) {}

ProgramCache::~ProgramCache() = default;

ProgramCache::Build& ProgramCache::buildOf(const Variant& variant) {
  Build*& known = known_[keyOf(variant)];
  if (known) return *known;
  const Variant needed{variant.fragment, mentioned(variant), variant.vertex};
  std::unique_ptr<Build>& build = builds_[keyOf(needed)];
  if (!build) {
    build = std::make_unique<Build>();
    build->variant = needed;
  }
  known = build.get();
  return *known;
}

void ProgramCache::request(const Variant& variant) {
  Build& build = buildOf(variant);
  if (build.state == Build::State::Idle) start(build);
}

int ProgramCache::poll() {
  int left = 0;
  for (const auto& [key, build] : builds_) {
    while (build->state == Build::State::Started && isComplete(*build))
      finish(*build);
    left += build->state == Build::State::Started;
  }
  return left;
}

const Program* ProgramCache::find(const Variant& variant) {
  Build& build = buildOf(variant);
  if (build.state == Build::State::Idle) start(build);
  while (build.state == Build::State::Started)
    finish(build);
  if (build.state == Build::State::Built) return &*build.built;
  error_ = keyOf(build.variant) + "\n" + build.log;
  startOver();
  return nullptr;
}

Uint ProgramCache::use(const std::string& fragment, const Definitions& definitions, const std::string& vertex) {
  const Program* program = find({fragment, definitions, vertex});
  if (!program) return 0;
  gl_.UseProgram(program->name());
  return program->name();
}

// ---------------------------------------------------------------------------------------------------------------------

void ProgramCache::start(Build& build) {
  build.state = Build::State::Started;
  build.program = ProgramObject(gl_);
  if (binaries_.areKept()) {
    build.storeKey = binaries_.keyOf(textsOf(build.variant, gl_.language));
    if (binaries_.load(build.program.name(), build.storeKey)) return;
  }
  compile(build);
}

// GL_KHR_parallel_shader_compile: until a status is asked for, none of these calls need wait.
void ProgramCache::compile(Build& build) {
  const Variant& variant = build.variant;
  const std::string text = completeSource(variant.fragment, variant.definitions, gl_.language);
  build.shaders = {std::make_shared<Shader>(gl_, variant.vertex.empty() ? COMPUTE_SHADER : FRAGMENT_SHADER, text)};
  if (!variant.vertex.empty()) build.shaders.push_back(sharedVertex(variant.vertex, variant.definitions));
  for (const ShaderPointer& shader : build.shaders)
    gl_.AttachShader(build.program.name(), shader->name());
  if (binaries_.areKept()) binaries_.makeRetrievable(build.program.name());
  gl_.LinkProgram(build.program.name());
}

ProgramCache::ShaderPointer ProgramCache::sharedVertex(const std::string& file, const Definitions& definitions) {
  const std::string text = completeSource(file, definitions, gl_.language);
  ShaderPointer& shader = vertexShaders_[text];
  if (!shader) shader = std::make_shared<Shader>(gl_, VERTEX_SHADER, text);
  return shader;
}

bool ProgramCache::isComplete(const Build& build) const {
  Int complete = 1;
  if (gl_.parallelCompile) gl_.GetProgramiv(build.program.name(), COMPLETION_STATUS, &complete);
  return complete != 0;
}

// To Built or Failed, or, where the driver refuses what was kept, to Started once more.
void ProgramCache::finish(Build& build) {
  const bool compiled = !build.shaders.empty();
  build.log = failureOf(build);
  if (!build.log.empty()) return compiled ? fail(build) : compile(build);
  const Uint name = build.program.name();
  for (const ShaderPointer& shader : build.shaders)
    gl_.DetachShader(name, shader->name());
  build.shaders.clear();
  label(gl_, PROGRAM, name, keyOf(build.variant));
  if (compiled && binaries_.areKept()) binaries_.save(name, build.storeKey);
  build.built.emplace(gl_, std::move(build.program));
  build.state = Build::State::Built;
  ++built_;
}

// Why it does not build; empty if it does. Waits for it.
std::string ProgramCache::failureOf(const Build& build) const {
  for (const ShaderPointer& shader : build.shaders)
    if (std::string log = shader->failure(); !log.empty()) return log;
  Int ok = 0;
  gl_.GetProgramiv(build.program.name(), LINK_STATUS, &ok);
  if (ok) return {};
  return "does not link: " + logOf(build.program.name(), gl_.GetProgramiv, gl_.GetProgramInfoLog);
}

// After a failure: what is not built yet may have failed for the same reason.
void ProgramCache::startOver() {
  for (const auto& [key, build] : builds_) {
    if (build->state == Build::State::Built) continue;
    build->program = {};
    build->shaders.clear();
    build->state = Build::State::Idle;
  }
  vertexShaders_.clear();
}

void ProgramCache::fail(Build& build) {
  build.program = {};
  build.shaders.clear();
  build.state = Build::State::Failed;
  vertexShaders_.clear(); // if one of them failed it is to be tried again, too
}

} // namespace tyndall::gl
