#include "passes/March.h"

namespace tyndall::passes::march {

Status run(SliceContext& context, const In& in, Out& out) {
  const slices::Out& slices = context.slices;
  context.selectDraw(in.draw);
  context.bindSlices();
  context.bind(gl::Unit::SampleEnds, in.sampleEnds);
  rows::bind(context, in.rows);
  setBlend(context.pass, in.draw == 0 ? Blend::Replace : Blend::AddAll);
  if (Status s = context.target(Target::Marched, slices.count, slices.samples / 16 + 1, out.marched); !s) return s;
  context.recorder.countMarched(slices.regularSamples);
  return context.drawSlices("march", "passes/march.frag", context.definitions, Along::SegmentsAndOne);
}

} // namespace tyndall::passes::march
