// What every pass draws with: the GL table, the programs and the one full-screen triangle.
#pragma once

#include "gl/Objects.h"
#include "gl/Program.h"

namespace tyndall::passes {

struct PassContext {
  const gl::Functions& gl;
  gl::ProgramCache& programs;
  gl::Uint nearestSampler; ///< nearest, clamped, compare mode off: engine textures keep their own parameters
};

/// How a pass's colour outputs join what is in the target.
enum class Blend {
  Replace,    ///< overwrite
  Add,        ///< target + source 0 (rgb); alpha stays
  AddAll,     ///< target + source 0, alpha too
  DualSource, ///< target * source 1 + source 0 (rgb); alpha stays
};

/// Binds a texture with our sampler.
void bindTexture(const PassContext& context, gl::Unit unit, gl::Enum target, gl::Uint texture);

void setBlend(const PassContext& context, Blend blend);

/// Draws the full-screen triangle with a fragment shader of glsl/passes; false if it does not build.
bool drawFullScreen(const PassContext& context, const std::string& fragment, const gl::Definitions& definitions);

/// Draws instances of the six vertices of a vertex shader of glsl/passes: one for 64 lines, slices or rows.
bool drawStrips(const PassContext& context, const gl::Variant& variant, int lines, int linesPerStrip);

} // namespace tyndall::passes
