#include "passes/SliceContext.h"

#include <algorithm>
#include <array>

namespace tyndall::passes {

namespace {

bool isWide(const SliceContext& context, Target which) {
  switch (which) {
  case Target::RowDepths:
  case Target::RowNodes:
  case Target::RowTree:
  case Target::PairTree:
    return context.slices.block.rowCode.w == 0;
  case Target::RowShares:
  case Target::RowNodeMeans:
  case Target::RowMeans:
    return context.inputs.variant.glass;
  default:
    return context.isColoured();
  }
}

} // namespace

void SliceContext::selectDraw(int draw) {
  glm::ivec4& march = slices.block.march;
  const int first = draw * slices.viewsPerDraw;
  march = glm::ivec4(first, std::min(slices.viewsPerDraw, march.w - first), draw == 0 ? 1 : 0, march.w);
  inputs.upload(2, &slices.block, sizeof slices.block);
}

void SliceContext::bindMaps() const {
  if (inputs.variant.shadowViews == 0) return;
  const gl::Enum target = inputs.variant.shadowArray ? gl::TEXTURE_2D_ARRAY : gl::TEXTURE_2D;
  bindTexture(pass, gl::Unit::ShadowMap, target, inputs.light->shadow.texture);
  if (!inputs.variant.glass) return;
  bindTexture(pass, gl::Unit::GlassColour, target, inputs.light->glass.colour);
  bindTexture(pass, gl::Unit::GlassDepth, target, inputs.light->glass.depth);
}

Status SliceContext::target(Target which, int width, int height, gl::Uint& texture) {
  texture = targets.get(which, width, height, isWide(*this, which));
  if (!texture) return slices::outOfMemory();
  gl.BindFramebuffer(gl::DRAW_FRAMEBUFFER, scratch.name());
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, texture, 0);
  const gl::Enum buffer = gl::COLOR_ATTACHMENT0;
  gl.DrawBuffers(1, &buffer);
  gl.Viewport(0, 0, width, height);
  return {};
}

Status SliceContext::attachMore(gl::Enum index, Target which, int width, int height, gl::Uint& texture) {
  texture = targets.get(which, width, height, isWide(*this, which));
  if (!texture) return slices::outOfMemory();
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0 + index, gl::TEXTURE_2D, texture, 0);
  const std::array<gl::Enum, 3> buffers = {gl::COLOR_ATTACHMENT0, gl::COLOR_ATTACHMENT0 + 1, gl::COLOR_ATTACHMENT0 + 2};
  gl.DrawBuffers(static_cast<gl::Sizei>(index + 1), buffers.data());
  return {};
}

void SliceContext::detachMore(gl::Enum kept) const {
  for (gl::Enum i = kept; i < 3; ++i)
    gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0 + i, gl::TEXTURE_2D, 0, 0);
}

Status SliceContext::draw(const std::string& name, const std::string& fragment, const gl::Definitions& with) {
  const bool ok = recorder.run(inputs.name + " " + name, [&] { return drawFullScreen(pass, fragment, with); });
  return ok ? Status{} : shaderError();
}

} // namespace tyndall::passes
