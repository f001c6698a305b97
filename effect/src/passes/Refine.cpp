#include "passes/Refine.h"

namespace tyndall::passes::refine {

Status run(SliceContext& context, const In& in, Out& out) {
  const slices::Out& slices = context.slices;
  context.bindSlices();
  context.bind(gl::Unit::Marks, in.marks);
  context.bind(gl::Unit::Marched, in.marched);
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::RefinedMarks, slices.count, slices.samples / 64, out.marks); !s) return s;
  if (Status s = context.drawSlices("refine", "passes/refine.frag", context.definitions); !s) return s;
  context.bind(gl::Unit::Marks, out.marks);
  if (Status s = context.target(Target::ExtraOffsets, slices.count, slices.samples / 64 + 1, out.offsets); !s) return s;
  return context.drawSlices("offsets", "passes/offsets.frag", {}, Along::Anything);
}

} // namespace tyndall::passes::refine
