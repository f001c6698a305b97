#include "passes/MeanLight.h"

namespace tyndall::passes::mean_light {

namespace {

constexpr const char* kShader = "passes/meanLight.frag";

gl::Definitions meanOf(gl::Definitions definitions, int step) {
  definitions.emplace_back("MEAN_OF", step);
  return definitions;
}

} // namespace

Status run(SliceContext& context, const In& in, Out& out) {
  gl::Uint sums = 0;
  context.bindSlices();
  context.bind(gl::Unit::Marched, in.marched);
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::SliceSums, context.slices.count, 1, sums); !s) return s;
  if (Status s = context.draw("slice sums", kShader, meanOf(context.definitions, 1)); !s) return s;
  context.bind(gl::Unit::SliceSums, sums);
  if (Status s = context.target(Target::MeanLight, 1, 1, out.mean); !s) return s;
  return context.draw("mean", kShader, meanOf(context.definitions, 2));
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  const gl::Definitions definitions = exact::definitionsOf(variant);
  return {{kShader, meanOf(definitions, 1)}, {kShader, meanOf(definitions, 2)}};
}

} // namespace tyndall::passes::mean_light
