#include "passes/Samples.h"

namespace tyndall::passes::samples {

Status runEnds(SliceContext& context, Out& out) {
  const slices::Out& slices = context.slices;
  context.selectDraw(0);
  context.bindSceneDepth();
  context.bindSlices();
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::SampleEnds, slices.count, slices.samples, out.ends); !s) return s;
  return context.drawSlices("sample ends", "passes/sampleEnds.frag", context.definitions);
}

Status copyEnds(SliceContext& context, gl::Uint from, Out& to) {
  setBlend(context.pass, Blend::Replace);
  context.bind(gl::Unit::ViewImage, from);
  if (Status s = context.target(Target::SampleEnds, context.slices.count, context.slices.samples, to.ends); !s)
    return s;
  return context.drawSlices("keep ends", "passes/copyTexels.frag", {});
}

Status runMarks(SliceContext& context, Out& out) {
  const slices::Out& slices = context.slices;
  context.bindSlices();
  context.bind(gl::Unit::SampleEnds, out.ends);
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::Marks, slices.count, slices.samples / 64, out.marks); !s) return s;
  return context.drawSlices("marks", "passes/marks.frag", context.definitions);
}

} // namespace tyndall::passes::samples
