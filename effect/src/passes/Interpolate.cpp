#include "passes/Interpolate.h"

namespace tyndall::passes::interpolate {

Status run(SliceContext& context, const In& in, Out& out) {
  const slices::Out& slices = context.slices;
  context.bindSlices();
  context.bind(gl::Unit::SampleEnds, in.sampleEnds);
  context.bind(gl::Unit::Marks, in.marks);
  context.bind(gl::Unit::ExtraOffsets, in.offsets);
  context.bind(gl::Unit::Marched, in.marched);
  context.bind(gl::Unit::Extra, in.extra.extra);
  if (context.isColoured()) {
    context.bind(gl::Unit::ExtraGreen, in.extra.extraGreen);
    context.bind(gl::Unit::ExtraBlue, in.extra.extraBlue);
  }
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::EpipolarInscatter, slices.count, slices.samples, out.inscatter); !s) return s;
  return context.drawSlices("interpolate", "passes/interpolate.frag", context.definitions);
}

} // namespace tyndall::passes::interpolate
