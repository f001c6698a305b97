#include "EmbeddedPrograms.h"

#include "gl/Variant.h"
#include "plan/Passes.h"
#include "support/TestContext.h"

#include <algorithm>
#include <gl/Gl.h>
#include <set>

using namespace tyndall;

namespace tests {

namespace {

// Shaders, and every two of a variant's definitions.
std::set<std::string> pairsOf(const gl::Variant& variant) {
  const gl::Definitions definitions = gl::mentioned(variant);
  const std::string shaders = variant.vertex + " " + variant.fragment;
  std::set<std::string> pairs = {shaders};
  for (const auto& a : definitions)
    for (const auto& b : definitions)
      if (a <= b)
        pairs.insert(shaders + " " + a.first + " " + std::to_string(a.second) + " " + b.first + " " +
                     std::to_string(b.second));
  return pairs;
}

// Those that have a pair which none before them has.
std::vector<gl::Variant> coverPairs(const std::vector<gl::Variant>& all) {
  std::set<std::string> known;
  std::vector<gl::Variant> taken;
  for (const gl::Variant& variant : all) {
    bool isNew = false;
    for (const std::string& pair : pairsOf(variant))
      isNew = known.insert(pair).second || isNew;
    if (isNew) taken.push_back(variant);
  }
  return taken;
}

std::string logOf(GLuint object, PFNGLGETSHADERIVPROC get, PFNGLGETSHADERINFOLOGPROC getLog) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  getLog(object, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

// What the driver says of a program that does not build; else nothing.
std::string failureOf(const gl::Variant& variant) {
  std::string said;
  const GLuint program = host::gl().CreateProgram();
  const auto add = [&](GLenum kind, const std::string& file) {
    const std::string text = gl::completeSource(file, variant.definitions, gl::Language::Essl);
    const char* pointer = text.c_str();
    const GLuint shader = host::gl().CreateShader(kind);
    host::gl().ShaderSource(shader, 1, &pointer, nullptr);
    host::gl().CompileShader(shader);
    GLint compiled = 0;
    host::gl().GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) said += file + ": " + logOf(shader, host::gl().GetShaderiv, host::gl().GetShaderInfoLog);
    host::gl().AttachShader(program, shader);
    host::gl().DeleteShader(shader);
  };
  add(GL_VERTEX_SHADER, variant.vertex);
  add(GL_FRAGMENT_SHADER, variant.fragment);
  host::gl().LinkProgram(program);
  GLint linked = 0;
  host::gl().GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) said += "link: " + logOf(program, host::gl().GetProgramiv, host::gl().GetProgramInfoLog);
  host::gl().DeleteProgram(program);
  return linked ? std::string() : gl::keyOf(variant) + ": " + said;
}

} // namespace

BuiltPrograms buildEmbeddedPairs() {
  testContext();
  std::vector<gl::Variant> all = allVariants(true);
  const std::vector<gl::Variant> oneSource = allVariants(false);
  all.insert(all.end(), oneSource.begin(), oneSource.end());
  BuiltPrograms built;
  for (const gl::Variant& variant : coverPairs(all)) {
    ++built.count;
    if (std::string failure = failureOf(variant); !failure.empty()) built.failures.push_back(std::move(failure));
  }
  return built;
}

} // namespace tests
