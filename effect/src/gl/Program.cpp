#include "gl/Program.h"

#include "gl/Enums.h"

#include <array>
#include <numeric>

namespace tyndall::gl {

namespace {

constexpr std::array<const char*, 3> kBlocks = {"FrameBlock", "LightBlock", "EpipolarBlock"};

// What a sampler of this type reads; NONE for what is no sampler of ours.
Enum targetOf(Int type) {
  switch (static_cast<Enum>(type)) {
  case SAMPLER_2D:
  case INT_SAMPLER_2D:
  case UNSIGNED_INT_SAMPLER_2D:
    return TEXTURE_2D;
  case SAMPLER_2D_ARRAY:
  case INT_SAMPLER_2D_ARRAY:
  case UNSIGNED_INT_SAMPLER_2D_ARRAY:
    return TEXTURE_2D_ARRAY;
  case SAMPLER_2D_MULTISAMPLE:
  case INT_SAMPLER_2D_MULTISAMPLE:
  case UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE:
    return TEXTURE_2D_MULTISAMPLE;
  case SAMPLER_2D_MULTISAMPLE_ARRAY:
    return TEXTURE_2D_MULTISAMPLE_ARRAY;
  default:
    return NONE;
  }
}

std::vector<Int> uniformTypes(const Functions& gl, Uint program) {
  Int count = 0;
  gl.GetProgramiv(program, ACTIVE_UNIFORMS, &count);
  std::vector<Uint> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), 0U);
  std::vector<Int> types(indices.size());
  if (count > 0) gl.GetActiveUniformsiv(program, count, indices.data(), UNIFORM_TYPE, types.data());
  return types;
}

std::string uniformName(const Functions& gl, Uint program, std::size_t index) {
  std::array<Char, 64> name{};
  gl.GetActiveUniformName(program, static_cast<Uint>(index), static_cast<Sizei>(name.size()), nullptr, name.data());
  return name.data();
}

} // namespace

Program::Program(const Functions& gl, ProgramObject program) : program_(std::move(program)) {
  gl.UseProgram(name());
  findSamplers(gl);
  bindBlocks(gl);
}

void Program::findSamplers(const Functions& gl) {
  const std::vector<Int> types = uniformTypes(gl, name());
  for (std::size_t i = 0; i < types.size(); ++i) {
    const Enum target = targetOf(types[i]);
    if (target == NONE) continue;
    const std::string sampler = uniformName(gl, name(), i);
    const auto unit = static_cast<Uint>(samplers_.size());
    gl.Uniform1i(gl.GetUniformLocation(name(), sampler.c_str()), static_cast<Int>(unit));
    samplers_.push_back({sampler, target, unit});
  }
}

void Program::bindBlocks(const Functions& gl) const {
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    if (const Uint index = gl.GetUniformBlockIndex(name(), kBlocks[i]); index != INVALID_INDEX)
      gl.UniformBlockBinding(name(), index, static_cast<Uint>(i));
}

} // namespace tyndall::gl
