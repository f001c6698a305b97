#include "gl/Program.h"

#include "gl/Enums.h"

#include <array>

namespace tyndall::gl {

namespace {

constexpr std::array<const char*, 3> kBlocks = {"FrameBlock", "LightBlock", "EpipolarBlock"};

// What a sampler of this type reads; NONE for what is no sampler of ours.
Enum targetOf(Enum type) {
  switch (type) {
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
  case SAMPLER_CUBE:
    return TEXTURE_CUBE_MAP;
  case SAMPLER_CUBE_MAP_ARRAY:
    return TEXTURE_CUBE_MAP_ARRAY;
  default:
    return NONE;
  }
}

} // namespace

Program::Program(const Functions& gl, ProgramObject program) : program_(std::move(program)) {
  gl.UseProgram(name());
  findSamplers(gl);
  bindBlocks(gl);
}

void Program::findSamplers(const Functions& gl) {
  Int count = 0;
  gl.GetProgramiv(name(), ACTIVE_UNIFORMS, &count);
  for (Uint i = 0; i < static_cast<Uint>(count); ++i) {
    std::array<Char, 64> sampler{}; // longer ones are of blocks
    Int size = 0;
    Enum type = NONE;
    gl.GetActiveUniform(name(), i, static_cast<Sizei>(sampler.size()), nullptr, &size, &type, sampler.data());
    const Enum target = targetOf(type);
    if (target == NONE) continue;
    const auto unit = static_cast<Uint>(samplers_.size());
    gl.Uniform1i(gl.GetUniformLocation(name(), sampler.data()), static_cast<Int>(unit));
    samplers_.push_back({sampler.data(), target, unit});
  }
}

void Program::bindBlocks(const Functions& gl) const {
  for (std::size_t i = 0; i < kBlocks.size(); ++i)
    if (const Uint index = gl.GetUniformBlockIndex(name(), kBlocks[i]); index != INVALID_INDEX)
      gl.UniformBlockBinding(name(), index, static_cast<Uint>(i));
  for (const char* withoutSlices : {"CopyBlock", "AmbientBlock"})
    if (const Uint index = gl.GetUniformBlockIndex(name(), withoutSlices); index != INVALID_INDEX)
      gl.UniformBlockBinding(name(), index, 2);
}

} // namespace tyndall::gl
