#include "passes/MarchExtra.h"

namespace tyndall::passes::march_extra {

namespace {

Status attachTargets(SliceContext& context, Out& out) {
  const int slices = context.slices.count, height = context.slices.samples / 4;
  if (Status s = context.target(Target::Extra, slices, height, out.extra); !s) return s;
  if (!context.isColoured()) return {};
  if (Status s = context.attachMore(1, Target::ExtraGreen, slices, height, out.extraGreen); !s) return s;
  return context.attachMore(2, Target::ExtraBlue, slices, height, out.extraBlue);
}

} // namespace

Status run(SliceContext& context, const In& in, Out& out) {
  context.selectDraw(in.draw);
  context.bindSlices();
  context.bind(gl::Unit::SampleEnds, in.sampleEnds);
  context.bind(gl::Unit::Marks, in.marks);
  context.bind(gl::Unit::ExtraOffsets, in.offsets);
  rows::bind(context, in.rows);
  setBlend(context.pass, in.draw == 0 ? Blend::Replace : Blend::AddAll);
  if (Status s = attachTargets(context, out); !s) return s;
  Status status =
      context.drawStrips("march extra", "passes/marchExtra.frag", context.definitions, context.slices.count, true);
  context.detachMore(1);
  return status;
}

} // namespace tyndall::passes::march_extra
