#include "passes/PixelTree.h"

#include "optics/Blocks.h"
#include "optics/LowRank.h"
#include "passes/TintSums.h"

namespace tyndall::passes::pixel_tree {

namespace {

constexpr const char* kShader = "passes/pixelTree.frag";

// Visits do not depend on the medium, nor on smoke.
gl::Definitions visitsOf(exact::Variant variant) {
  variant.monochrome = true;
  variant.curves = false;
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("COUNT_VISITS", 1);
  return definitions;
}

struct Tables {
  bool lowRank = false;
  bool tintSums = false;
};

gl::Definitions pixelsOf(const exact::Variant& variant, const Tables& tables) {
  gl::Definitions definitions = rows::definitionsOf(variant, tables.tintSums);
  if (tables.lowRank) definitions.emplace_back("LOW_RANK", 1);
  return definitions;
}

// An orthographic camera's rays cross one light ray at different distances: they have no sums in common. Behind smoke
// there are none.
bool usesTintSums(const SliceContext& context) {
  return context.inputs.variant.glass && !context.inputs.variant.curves && context.slices.block.grid.w > 0 &&
         optics::frameBlock(*context.inputs.frame, {}).depthToT.z == 0;
}

// Technique::LowRank's tables, unless the light is one that it does not apply to.
Status makeLowRank(SliceContext& context, Tables& tables) {
  const Frame& frame = *context.inputs.frame;
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
  tables = {true, usesTintSums(context)};
  return {};
}

Status drawPixels(SliceContext& context, int draw, const Tables& tables) {
  const Frame& frame = *context.inputs.frame;
  if (Status s = context.inputs.attachDestination(false, draw == 0); !s) return s;
  setBlend(context.pass, draw == 0 ? context.inputs.blend : Blend::Add);
  context.recorder.countMarched(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
  return context.draw("pixels", kShader, pixelsOf(context.inputs.variant, tables));
}

Status drawVisits(SliceContext& context) {
  if (Status s = context.inputs.attachView(false); !s) return s;
  setBlend(context.pass, Blend::AddAll);
  return context.draw("view", kShader, visitsOf(context.inputs.variant));
}

} // namespace

Status run(SliceContext& context, const In& in) {
  rows::Out rows;
  Tables tables;
  if (!in.countVisits)
    if (Status s = makeLowRank(context, tables); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (Status s = rows::run(context, {draw, tables.tintSums}, rows); !s) return s;
    context.selectDraw(draw);
    context.bindSceneDepth();
    context.bindSlices();
    rows::bind(context, rows);
    if (tables.tintSums)
      if (Status s = tint_sums::run(context, {rows}); !s) return s;
    if (Status s = in.countVisits ? drawVisits(context) : drawPixels(context, draw, tables); !s) return s;
  }
  return {};
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  std::vector<gl::Variant> all = {{kShader, pixelsOf(variant, {})}, {kShader, pixelsOf(variant, {true, false})}};
  if (variant.glass && !variant.curves) {
    all.push_back({kShader, pixelsOf(variant, {true, true})});
    for (const gl::Variant& sums : tint_sums::variantsOf(variant))
      all.push_back(sums);
  }
  if (variant.monochrome && !variant.composite) all.push_back({kShader, visitsOf(variant)});
  return all;
}

} // namespace tyndall::passes::pixel_tree
