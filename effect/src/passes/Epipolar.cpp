#include "passes/Epipolar.h"

#include "passes/DebugSlices.h"
#include "passes/Lookup.h"
#include "passes/PixelTree.h"
#include "passes/Rows.h"
#include "passes/SliceChoice.h"
#include "passes/Unwarp.h"

#include <cmath>

// One light. Boxes are passes, the rest are textures (plan/Resources.cpp); [rows] and both marches run once for all
// shadow views, or for some at a time (LightPlanner::draws).
//
//   light, camera --> [slices] --> slice table, which all passes read
//   shadow map, glass map --> [rows] --> row depths, row tree
//
//   Techniques tree and lowrank:
//                        scene depth, row depths, row tree --> [pixel tree] --> destination
//
//   Technique epipolar:  slices --> [slice choice] --> slice table (with Settings::errorTarget)
//                        scene depth --> [samples] --> sample ends, marks
//                        sample ends, rows --> [march] --> marched
//                        marched --> [mean light] --> mean light
//                        marks, marched --> [refine] --> refined marks, offsets
//                        sample ends, refined marks, offsets, rows --> [march extra] --> extra
//                        sample ends, refined marks, offsets, marched, extra --> [interpolate] --> epipolar inscatter
//                        epipolar inscatter, mean light, scene depth --> [unwarp] --> destination, stencil
//                        pixels that it left, rows --> fix-up --> destination
//
namespace tyndall::passes::epipolar {

namespace {

// Samples between the regular ones, and the light of all.
void planExtra(LightPlanner& light) {
  light.draw(Pass::Refine);
  light.draw(Pass::Offsets);
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    if (light.draws() > 1) rows::plan(light); // else they are at hand
    light.draw(Pass::MarchExtra, {{}, {}, {Count::Marched}});
  }
  light.draw(Pass::Interpolate);
}

void planEpipolar(LightPlanner& light) {
  if (slice_choice::isMade(light)) slice_choice::plan(light);
  light.selectDraw(0);
  light.draw(Pass::SampleEnds, {{{"KEEPS_ENDS", 0}}});
  if (light.draws() == 1) rows::plan(light);
  planToInterpolate(light);
  unwarp::plan(light);
}

} // namespace

void plan(LightPlanner& light, DebugView view) {
  bool rowsAtHand = true;
  if (light.frame.settings.technique == Technique::Epipolar)
    planEpipolar(light);
  else
    rowsAtHand = pixel_tree::plan(light);
  if (light.fillsLookup) lookup::addLight(light, rowsAtHand);
  debug_slices::plan(light, view);
}

void planToInterpolate(LightPlanner& light) {
  const bool chosen = slice_choice::isMade(light); // and counted
  light.draw(Pass::Marks);
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    if (light.draws() > 1) rows::plan(light);
    light.draw(Pass::March);
  }
  if (!chosen) {
    light.plan.marched += light.regularSamples * static_cast<std::uint64_t>(light.draws());
    light.plan.slices += static_cast<std::uint64_t>(light.extent.slices);
  }
  if (std::isfinite(light.frame.settings.spreadThreshold)) {
    light.draw(Pass::SliceSums);
    light.draw(Pass::MeanLight);
  }
  planExtra(light);
}

} // namespace tyndall::passes::epipolar
