#include "passes/PixelTree.h"

#include "optics/Blocks.h"
#include "optics/LowRank.h"
#include "passes/Rows.h"
#include "passes/Samples.h"
#include "passes/TintSums.h"

#include <utility>

namespace tyndall::passes::pixel_tree {

namespace {

struct Tables {
  bool lowRank = false, tintSums = false;
};

// An orthographic camera's rays cross one light ray at different distances: they have no sums in common. Behind smoke
// there are none.
bool usesTintSums(const LightPlanner& light) {
  return light.variant.glass && !light.variant.curves && light.extent.treeLevels > 0 &&
         optics::frameBlock(light.frame, {}).isOrthographic == 0;
}

// Technique::LowRank's tables, unless the light is one that it does not apply to.
Tables planLowRank(LightPlanner& light) {
  if (light.frame.settings.technique != Technique::LowRank) return {};
  if (light.variant.eyeCurves) {
    light.skip("low rank", "what stands before the eye dims each ray in its own way");
    return {};
  }
  auto table = optics::makeLowRank(light.frame, light.light, light.geometry);
  if (!table) {
    light.skip(
        "low rank",
        "light in a plane through eye and light depends on more than two coordinates, or no ray has an angle to it");
    return {};
  }
  light.extent.lowRankSets = table->sets;
  table->describe(light.block);
  light.upload(Resource::LowRankRays, std::move(table->rays));
  light.upload(Resource::LowRankLights, std::move(table->lights));
  return {true, usesTintSums(light)};
}

} // namespace

bool plan(LightPlanner& light) {
  const Tables tables = planLowRank(light);
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    rows::plan(light, tables.tintSums ? rows::Walk::TintSums : rows::Walk::Lit);
    if (tables.tintSums) tint_sums::plan(light);
    light.plan.marched += light.pixels();
    if (light.extent.sampledDepth && light.firstLight && draw == 0)
      light.draw(Pass::Transmittance, rowOf(Pass::Transmittance).name, {{}, onEdges({})});
    if (tables.lowRank)
      samples::drawLight(light, Pass::PixelsByLowRank,
                         {tables.tintSums ? gl::Definitions{{"TINT_SUMS", 1}} : gl::Definitions{}});
    else
      samples::drawLight(light, Pass::PixelTree, {});
  }
  return !tables.tintSums;
}

void planVisits(LightPlanner& light) {
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    rows::plan(light);
    light.draw(Pass::DebugVisitsOfLight);
  }
}

} // namespace tyndall::passes::pixel_tree
