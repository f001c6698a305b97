#include "passes/Unwarp.h"

namespace tyndall::passes::unwarp {

namespace {

// Draws unwarp and counts the pixels that it wrote: none are known while a query of the engine is under way.
Status drawCounted(SliceContext& context, gl::Uint64& served) {
  const gl::Functions& gl = context.gl;
  gl::Int busy = 0;
  gl.GetQueryiv(gl::SAMPLES_PASSED, gl::CURRENT_QUERY, &busy); // the engine's own query may be under way
  if (!busy) gl.BeginQuery(gl::SAMPLES_PASSED, context.objects.fixup.name());
  Status status = context.draw("unwarp", "passes/unwarp.frag", context.definitions);
  if (!busy) gl.EndQuery(gl::SAMPLES_PASSED);
  if (!busy) gl.GetQueryObjectui64v(context.objects.fixup.name(), gl::QUERY_RESULT, &served);
  return status;
}

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
  gl::Uint64 served = 0;
  Status status = drawCounted(context, served);
  const auto pixels = static_cast<gl::Uint64>(frame.width) * static_cast<gl::Uint64>(frame.height);
  context.recorder.countFixup(pixels - served);
  context.recorder.countMarched(pixels - served);
  if (status && served == pixels) context.recorder.skip(context.inputs.name + " fix-up", "every pixel was served");
  if (status && served < pixels) status = fixUp(context, in);
  gl.Disable(gl::STENCIL_TEST);
  return status;
}

} // namespace tyndall::passes::unwarp
