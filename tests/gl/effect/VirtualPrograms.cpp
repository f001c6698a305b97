// Shaders and programs of a FaultyContext: names of our own that stand for GL's. GL compiles each text once; what an
// effect links anew from the same texts is the same program of GL's.
#include "FaultyState.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace tests::faulty {

namespace {

using host::gl;

constexpr GLenum kCompletionStatus = 0x91B1; // of KHR_parallel_shader_compile
constexpr GLenum kBinaryFormat = 0xB1A5;
constexpr GLuint kFirstName = 0x40000000; // no name of GL's
constexpr int kPolls = 3;                 // until a program is complete
constexpr std::size_t kBinaryBytes = 64;

struct Shader {
  GLenum kind = 0;
  std::string text;
  GLuint real = 0;
  bool fails = false, deleted = false;
  int polls = 0;
};

struct Program {
  std::vector<GLuint> shaders, linked; // attached, and when it was linked
  GLuint real = 0;
  bool fails = false; // as told, or for a shader that did not compile
  int polls = 0;
};

struct Names {
  GLuint next = kFirstName;
  std::map<GLuint, Shader> shaders;
  std::map<GLuint, Program> programs;
};

Names& names() {
  static Names theNames;
  return theNames;
}

// What GL has compiled, for all contexts like this; texts by kind, programs by the names of GL's shaders.
std::map<std::string, GLuint>& realShaders() {
  static std::map<std::string, GLuint> all;
  return all;
}
std::map<std::vector<GLuint>, GLuint>& realPrograms() {
  static std::map<std::vector<GLuint>, GLuint> all;
  return all;
}
std::map<std::vector<std::uint8_t>, GLuint>& binaries() {
  static std::map<std::vector<std::uint8_t>, GLuint> all;
  return all;
}

GLuint realName(GLuint name) {
  const auto found = names().programs.find(name);
  return found == names().programs.end() ? name : found->second.real;
}

template <typename Object>
bool isPending(const Object& object) {
  return state().compiling == Compiling::Parallel && object.polls > 0;
}

// Anything but to ask whether it is complete waits until it is.
template <typename Object>
void await(Object& object, const char* call) {
  if (isPending(object)) state().counts.compileWaits.emplace_back(call);
  object.polls = 0;
}

void awaitProgram(GLuint name, const char* call) {
  const auto found = names().programs.find(name);
  if (found != names().programs.end()) await(found->second, call);
}

template <typename Object>
GLint isComplete(Object& object) {
  if (!isPending(object)) return GL_TRUE;
  --object.polls;
  return GL_FALSE;
}

// ---------------------------------------------------------------------------------------------------------------------
// Shaders

GLuint GLAD_API_PTR createShader(GLenum kind) {
  state().counts.made["glCreateShader"] += 1;
  const GLuint name = names().next++;
  names().shaders[name].kind = kind;
  return name;
}

// It may still be attached.
void GLAD_API_PTR deleteShader(GLuint name) {
  if (name == 0) return;
  state().counts.deleted["glDeleteShader"] += 1;
  names().shaders[name].deleted = true;
}

GLboolean GLAD_API_PTR isShader(GLuint name) {
  const auto found = names().shaders.find(name);
  return found != names().shaders.end() ? !found->second.deleted : gl().IsShader(name);
}

void GLAD_API_PTR shaderSource(GLuint name, GLsizei n, const GLchar* const* texts, const GLint* lengths) {
  std::string& text = names().shaders[name].text;
  text.clear();
  for (GLsizei i = 0; i < n; ++i)
    text += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i];
}

void GLAD_API_PTR compileShader(GLuint name) {
  ++state().counts.compiles;
  Shader& shader = names().shaders[name];
  shader.fails = fails(Fault::Compile);
  shader.polls = kPolls;
  GLuint& real = realShaders()[std::to_string(shader.kind) + "\n" + shader.text];
  if (real == 0) {
    real = gl().CreateShader(shader.kind);
    const GLchar* text = shader.text.c_str();
    gl().ShaderSource(real, 1, &text, nullptr);
    gl().CompileShader(real);
  }
  shader.real = real;
  shader.text.clear();
}

void GLAD_API_PTR getShaderiv(GLuint name, GLenum what, GLint* value) {
  Shader& shader = names().shaders[name];
  if (what == kCompletionStatus) {
    *value = isComplete(shader);
    return;
  }
  await(shader, "glGetShaderiv");
  gl().GetShaderiv(shader.real, what, value);
  if (what == GL_COMPILE_STATUS && shader.fails) *value = GL_FALSE;
}

void GLAD_API_PTR getShaderInfoLog(GLuint name, GLsizei size, GLsizei* length, GLchar* log) {
  Shader& shader = names().shaders[name];
  await(shader, "glGetShaderInfoLog");
  gl().GetShaderInfoLog(shader.real, size, length, log);
}

// ---------------------------------------------------------------------------------------------------------------------
// Programs

GLuint GLAD_API_PTR createProgram() {
  state().counts.made["glCreateProgram"] += 1;
  const GLuint name = names().next++;
  names().programs[name] = {};
  return name;
}

void GLAD_API_PTR deleteProgram(GLuint name) {
  if (name != 0) state().counts.deleted["glDeleteProgram"] += 1;
  names().programs.erase(name);
}

GLboolean GLAD_API_PTR isProgram(GLuint name) { return names().programs.count(name) != 0 || gl().IsProgram(name); }

void GLAD_API_PTR attachShader(GLuint program, GLuint shader) { names().programs[program].shaders.push_back(shader); }
void GLAD_API_PTR detachShader(GLuint program, GLuint shader) {
  std::vector<GLuint>& all = names().programs[program].shaders;
  all.erase(std::remove(all.begin(), all.end(), shader), all.end());
}

void GLAD_API_PTR linkProgram(GLuint name) {
  ++state().counts.links;
  Program& program = names().programs[name];
  program.fails = fails(Fault::Link);
  program.polls = kPolls;
  program.linked = program.shaders;
  std::vector<GLuint> reals;
  for (const GLuint shader : program.shaders) {
    reals.push_back(names().shaders[shader].real);
    program.fails = program.fails || names().shaders[shader].fails;
  }
  std::sort(reals.begin(), reals.end());
  GLuint& real = realPrograms()[reals];
  if (real == 0) {
    real = gl().CreateProgram();
    for (const GLuint shader : reals)
      if (shader != 0) gl().AttachShader(real, shader);
    gl().LinkProgram(real);
  }
  program.real = real;
}

GLint isLinked(const Program& program) {
  GLint linked = GL_FALSE;
  if (program.real != 0 && !program.fails) gl().GetProgramiv(program.real, GL_LINK_STATUS, &linked);
  return linked;
}

void GLAD_API_PTR getProgramiv(GLuint name, GLenum what, GLint* value) {
  const auto known = names().programs.find(name);
  if (known == names().programs.end()) return gl().GetProgramiv(name, what, value); // the engine's
  Program& program = known->second;
  if (what == kCompletionStatus) {
    *value = isComplete(program);
    if (*value)
      for (const GLuint shader : program.linked)
        names().shaders[shader].polls = 0;
    return;
  }
  await(program, "glGetProgramiv");
  *value = 0;
  if (what == GL_LINK_STATUS)
    *value = isLinked(program);
  else if (what == GL_PROGRAM_BINARY_LENGTH)
    *value = state().binaryFormats > 0 && isLinked(program) ? static_cast<GLint>(kBinaryBytes) : 0;
  else if (program.real != 0)
    gl().GetProgramiv(program.real, what, value);
}

void GLAD_API_PTR getProgramInfoLog(GLuint name, GLsizei size, GLsizei* length, GLchar* log) {
  awaitProgram(name, "glGetProgramInfoLog");
  if (const GLuint real = realName(name); real != 0) return gl().GetProgramInfoLog(real, size, length, log);
  if (length) *length = 0;
  if (size > 0) *log = '\0';
}

void GLAD_API_PTR useProgram(GLuint name) {
  awaitProgram(name, "glUseProgram");
  gl().UseProgram(realName(name));
}

// ---------------------------------------------------------------------------------------------------------------------
// Binaries: numbers that stand for a program of GL's.

std::vector<std::uint8_t> binaryOf(GLuint real) {
  std::vector<std::uint8_t> bytes(kBinaryBytes, 0x5A);
  std::memcpy(bytes.data(), &real, sizeof real);
  return bytes;
}

void GLAD_API_PTR getProgramBinary(GLuint name, GLsizei size, GLsizei* length, GLenum* format, void* bytes) {
  awaitProgram(name, "glGetProgramBinary");
  const std::vector<std::uint8_t> binary = binaryOf(realName(name));
  if (length) *length = 0;
  if (state().binaryFormats == 0 || size < static_cast<GLsizei>(kBinaryBytes)) return recordError(GL_INVALID_OPERATION);
  binaries()[binary] = realName(name);
  if (length) *length = static_cast<GLsizei>(kBinaryBytes);
  *format = kBinaryFormat;
  std::memcpy(bytes, binary.data(), kBinaryBytes);
}

void GLAD_API_PTR programBinary(GLuint name, GLenum format, const void* bytes, GLsizei length) {
  ++state().counts.loadedBinaries;
  Program& program = names().programs[name];
  program = {};
  program.fails = fails(Fault::Binary);
  if (state().binaryFormats == 0 || format != kBinaryFormat) return recordError(GL_INVALID_ENUM);
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  const auto found = binaries().find({from, from + length});
  if (found != binaries().end()) program.real = found->second;
}

// ---------------------------------------------------------------------------------------------------------------------
// Functions that name a program and else do what GL does

template <auto kMember>
struct OfProgram;
template <typename R, typename... A, R (GLAD_API_PTR* GladGLContext::*kMember)(GLuint, A...)>
struct OfProgram<kMember> {
  static R GLAD_API_PTR call(GLuint program, A... arguments) {
    awaitProgram(program, "a function of a program");
    return (gl().*kMember)(realName(program), arguments...);
  }
};

// That a binary will be asked for: it always may.
void GLAD_API_PTR programParameteri(GLuint, GLenum, GLint) {}

void GLAD_API_PTR objectLabel(GLenum kind, GLuint name, GLsizei length, const GLchar* label) {
  if (name < kFirstName) gl().ObjectLabel(kind, name, length, label);
}

#define TESTS_OF_PROGRAM(name) targets[Call::name] = addressOf(OfProgram<&GladGLContext::name>::call)

void replaceOthers(Targets& targets) {
  TESTS_OF_PROGRAM(GetUniformLocation);
  TESTS_OF_PROGRAM(GetUniformBlockIndex);
  TESTS_OF_PROGRAM(UniformBlockBinding);
  TESTS_OF_PROGRAM(ShaderStorageBlockBinding);
  TESTS_OF_PROGRAM(ProgramUniform1i);
  TESTS_OF_PROGRAM(ProgramUniform1ui);
  TESTS_OF_PROGRAM(ProgramUniform1f);
  TESTS_OF_PROGRAM(ProgramUniform1iv);
  TESTS_OF_PROGRAM(GetActiveUniform);
  TESTS_OF_PROGRAM(GetActiveUniformBlockiv);
  TESTS_OF_PROGRAM(GetActiveUniformName);
  TESTS_OF_PROGRAM(GetActiveUniformsiv);
  TESTS_OF_PROGRAM(GetUniformIndices);
  TESTS_OF_PROGRAM(GetUniformiv);
  TESTS_OF_PROGRAM(GetProgramResourceIndex);
  TESTS_OF_PROGRAM(GetProgramResourceiv);
  TESTS_OF_PROGRAM(GetProgramInterfaceiv);
  TESTS_OF_PROGRAM(GetProgramResourceLocation);
  targets[Call::ProgramParameteri] = addressOf(programParameteri);
  targets[Call::ObjectLabel] = addressOf(objectLabel);
}

} // namespace

void replacePrograms(Targets& targets) {
  targets[Call::CreateShader] = addressOf(createShader);
  targets[Call::DeleteShader] = addressOf(deleteShader);
  targets[Call::IsShader] = addressOf(isShader);
  targets[Call::ShaderSource] = addressOf(shaderSource);
  targets[Call::CompileShader] = addressOf(compileShader);
  targets[Call::GetShaderiv] = addressOf(getShaderiv);
  targets[Call::GetShaderInfoLog] = addressOf(getShaderInfoLog);
  targets[Call::CreateProgram] = addressOf(createProgram);
  targets[Call::DeleteProgram] = addressOf(deleteProgram);
  targets[Call::IsProgram] = addressOf(isProgram);
  targets[Call::AttachShader] = addressOf(attachShader);
  targets[Call::DetachShader] = addressOf(detachShader);
  targets[Call::LinkProgram] = addressOf(linkProgram);
  targets[Call::GetProgramiv] = addressOf(getProgramiv);
  targets[Call::GetProgramInfoLog] = addressOf(getProgramInfoLog);
  targets[Call::UseProgram] = addressOf(useProgram);
  targets[Call::GetProgramBinary] = addressOf(getProgramBinary);
  targets[Call::ProgramBinary] = addressOf(programBinary);
  replaceOthers(targets);
}

void clearPrograms() {
  const GLuint next = names().next;
  names() = {};
  names().next = next;
}

void forgetBinaries() { binaries().clear(); }

} // namespace tests::faulty
