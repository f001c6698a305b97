#include "ComputeProgram.h"

#include "baselines/ShaderText.h"

#include <scene/Error.h>

namespace avsmbench {

using host::gl;

ComputeProgram::ComputeProgram(const std::vector<std::string>& files, const Defines& defines,
                               const std::string& declarations)
    : name_(gl().CreateProgram()) {
  std::string source = "#version 430 core\n";
  for (const auto& [name, value] : defines)
    source += "#define " + name + " " + std::to_string(value) + "\n";
  source += declarations + bench::shaderBody(files);
  const GLuint shader = gl().CreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  gl().ShaderSource(shader, 1, &text, nullptr);
  gl().CompileShader(shader);
  gl().AttachShader(name_, shader);
  gl().LinkProgram(name_);
  char log[4096] = "";
  gl().GetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl().DeleteShader(shader);
  GLint linked = 0;
  gl().GetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked) return;
  gl().DeleteProgram(name_);
  throw host::Error(files.back() + ": did not build: " + log);
}

ComputeProgram::~ComputeProgram() {
  gl().UseProgram(0);
  gl().DeleteProgram(name_);
}

void ComputeProgram::use() const { gl().UseProgram(name_); }

void ComputeProgram::set(const char* uniform, int value) const {
  gl().Uniform1i(gl().GetUniformLocation(name_, uniform), value);
}

void ComputeProgram::set(const char* uniform, float value) const {
  gl().Uniform1f(gl().GetUniformLocation(name_, uniform), value);
}

void ComputeProgram::dispatch(std::size_t groupsX, std::size_t groupsY) {
  gl().DispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY), 1);
  gl().MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void fillStorage(const host::GlBuffer& buffer, GLuint binding, std::size_t bytes, const void* data) {
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  gl().BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_DYNAMIC_COPY);
}

} // namespace avsmbench
