#include "passes/PassContext.h"

namespace tyndall::passes {

void bindTexture(const PassContext& context, gl::Unit unit, gl::Enum target, gl::Uint texture) {
  const auto index = static_cast<gl::Uint>(unit);
  context.gl.ActiveTexture(gl::TEXTURE0 + index);
  context.gl.BindTexture(target, texture);
  // A multisampled texture takes no sampler.
  context.gl.BindSampler(index, target == gl::TEXTURE_2D_MULTISAMPLE ? 0 : context.nearestSampler);
}

void setBlend(const PassContext& context, Blend blend) {
  const gl::Functions& gl = context.gl;
  if (blend == Blend::Replace) {
    gl.Disable(gl::BLEND);
    // Mesa refuses to draw into several targets while the function has a second source, though blending is off.
    gl.BlendFuncSeparate(gl::ONE, gl::ZERO, gl::ONE, gl::ZERO);
    return;
  }
  gl.Enable(gl::BLEND);
  gl.BlendEquationSeparate(gl::FUNC_ADD, gl::FUNC_ADD);
  const gl::Enum alpha = blend == Blend::AddAll ? gl::ONE : gl::ZERO;
  gl.BlendFuncSeparate(gl::ONE, blend == Blend::DualSource ? gl::SRC1_COLOR : gl::ONE, alpha, gl::ONE);
}

bool drawFullScreen(const PassContext& context, const std::string& fragment, const gl::Definitions& definitions) {
  if (context.programs.use(fragment, definitions) == 0) return false;
  context.gl.DrawArrays(gl::TRIANGLES, 0, 3);
  return true;
}

bool drawStrips(const PassContext& context, const gl::Variant& variant, int lines, int linesPerStrip) {
  if (context.programs.use(variant.fragment, variant.definitions, variant.vertex) == 0) return false;
  context.gl.DrawArraysInstanced(gl::TRIANGLES, 0, 6, (lines + linesPerStrip - 1) / linesPerStrip);
  return true;
}

} // namespace tyndall::passes
