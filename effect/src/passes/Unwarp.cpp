#include "passes/Unwarp.h"

namespace tyndall::passes::unwarp {

namespace {

// The pixels that are left, along their slice's tree. With several views only the last one's rows are at hand: those
// pixels then walk every texel.
Status fixUp(SliceContext& context, const In& in) {
  context.gl.StencilFunc(gl::EQUAL, 0, 0xFF);
  context.gl.StencilOp(gl::KEEP, gl::KEEP, gl::KEEP);
  rows::bind(context, in.rows);
  return context.draw("fix-up", context.views() > 1 ? "passes/exact.frag" : "passes/pixelTree.frag",
                      context.definitions);
}

} // namespace

Status run(SliceContext& context, const In& in) {
  const gl::Functions& gl = context.gl;
  const Frame& frame = *context.inputs.frame;
  context.bindSceneDepth();
  context.bindSlices();
  context.bind(gl::Unit::EpipolarInscatter, in.epipolarInscatter);
  if (Status s = context.inputs.attachDestination(true, true); !s) return s;
  const gl::Int zero = 0;
  gl.StencilMask(0xFF);
  gl.ClearBufferiv(gl::STENCIL, 0, &zero);
  gl.Enable(gl::STENCIL_TEST);
  gl.StencilFunc(gl::ALWAYS, 1, 0xFF);
  gl.StencilOp(gl::KEEP, gl::KEEP, gl::REPLACE);
  setBlend(context.pass, context.inputs.blend);
  Status status;
  const std::uint64_t served = context.recorder.countWritten(
      [&] { status = context.draw("unwarp", "passes/unwarp.frag", context.definitions); });
  const auto pixels = static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
  context.recorder.countFixup(pixels - served);
  context.recorder.countMarched(pixels - served);
  if (status && served == pixels) context.recorder.skip(context.inputs.name + " fix-up", "every pixel was served");
  if (status && served < pixels) status = fixUp(context, in);
  gl.Disable(gl::STENCIL_TEST);
  return status;
}

} // namespace tyndall::passes::unwarp
