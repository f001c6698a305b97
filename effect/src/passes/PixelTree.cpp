#include "passes/PixelTree.h"

#include "optics/LowRank.h"

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

gl::Definitions pixelsOf(const exact::Variant& variant, bool lowRank) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  if (lowRank) definitions.emplace_back("LOW_RANK", 1);
  return definitions;
}

// Technique::LowRank's tables; `used` unless the light is one that it does not apply to.
Status makeLowRank(SliceContext& context, bool& used) {
  const Frame& frame = *context.inputs.frame;
  used = false;
  if (frame.settings.technique != Technique::LowRank) return {};
  const auto table = optics::makeLowRank(frame, *context.inputs.light, context.slices.geometry);
  if (!table) return {};
  const int terms = frame.settings.lowRankTerms, grid = optics::kLowRankGrid;
  const auto upload = [&](gl::Unit unit, Target which, int width, int height, const std::vector<glm::vec4>& texels) {
    gl::Uint texture = 0;
    Status status = slices::uploadTable(context.pass, context.targets, which, width, height, texels, texture);
    context.bind(unit, texture);
    return status;
  };
  if (Status s = upload(gl::Unit::LowRankRays, Target::LowRankRays, grid, terms, table->rays); !s) return s;
  if (Status s = upload(gl::Unit::LowRankLights, Target::LowRankLights, table->sets, 2 * terms * grid, table->lights);
      !s)
    return s;
  context.slices.block.lowRankRay = table->ray;
  context.slices.block.lowRankLight = table->light;
  used = true;
  return {};
}

Status drawPixels(SliceContext& context, int draw, bool lowRank) {
  const Frame& frame = *context.inputs.frame;
  if (Status s = context.inputs.attachDestination(false, draw == 0); !s) return s;
  setBlend(context.pass, draw == 0 ? context.inputs.blend : Blend::Add);
  context.recorder.countMarched(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
  return context.draw("pixels", kShader, pixelsOf(context.inputs.variant, lowRank));
}

Status drawVisits(SliceContext& context) {
  if (Status s = context.inputs.attachView(false); !s) return s;
  setBlend(context.pass, Blend::AddAll);
  return context.draw("view", kShader, visitsOf(context.inputs.variant));
}

} // namespace

Status run(SliceContext& context, const In& in) {
  rows::Out rows;
  bool lowRank = false;
  if (!in.countVisits)
    if (Status s = makeLowRank(context, lowRank); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (Status s = rows::run(context, {draw}, rows); !s) return s;
    context.selectDraw(draw);
    context.bindSceneDepth();
    context.bindSlices();
    rows::bind(context, rows);
    if (Status s = in.countVisits ? drawVisits(context) : drawPixels(context, draw, lowRank); !s) return s;
  }
  return {};
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  std::vector<gl::Variant> all = {{kShader, pixelsOf(variant, false)}, {kShader, pixelsOf(variant, true)}};
  if (variant.monochrome && !variant.composite) all.push_back({kShader, visitsOf(variant)});
  return all;
}

} // namespace tyndall::passes::pixel_tree
