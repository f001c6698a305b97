#include "passes/PixelTree.h"

namespace tyndall::passes::pixel_tree {

namespace {

constexpr const char* kShader = "passes/pixelTree.frag";

// Visits do not depend on the medium.
gl::Definitions visitsOf(exact::Variant variant) {
  variant.monochrome = true;
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("COUNT_VISITS", 1);
  return definitions;
}

Status drawPixels(SliceContext& context, int draw) {
  const Frame& frame = *context.inputs.frame;
  if (Status s = context.inputs.attachDestination(false, draw == 0); !s) return s;
  setBlend(context.pass, draw == 0 ? context.inputs.blend : Blend::Add);
  context.recorder.countMarched(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
  return context.draw("pixels", kShader, context.definitions);
}

Status drawVisits(SliceContext& context) {
  if (Status s = context.inputs.attachView(false); !s) return s;
  setBlend(context.pass, Blend::AddAll);
  return context.draw("view", kShader, visitsOf(context.inputs.variant));
}

} // namespace

Status run(SliceContext& context, const In& in) {
  rows::Out rows;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (Status s = rows::run(context, {draw}, rows); !s) return s;
    context.selectDraw(draw);
    context.bindSceneDepth();
    context.bindSlices();
    rows::bind(context, rows);
    if (Status s = in.countVisits ? drawVisits(context) : drawPixels(context, draw); !s) return s;
  }
  return {};
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  std::vector<gl::Variant> all = {{kShader, exact::definitionsOf(variant)}};
  if (variant.monochrome && !variant.composite) all.push_back({kShader, visitsOf(variant)});
  return all;
}

} // namespace tyndall::passes::pixel_tree
