#include "passes/Unwarp.h"

#include "passes/Rows.h"
#include "passes/Samples.h"
#include "passes/SliceChoice.h"

#include <cmath>

namespace tyndall::passes::unwarp {

namespace {

// The few pixels that no sample serves: along their slice's row. With several draws only the last one's rows are at
// hand, and to make them all again would take longer than every texel does.
void planUnserved(LightPlanner& light, const Counting& counting) {
  const DrawOptions options{{}, kOnlyUnserved, counting};
  const bool ahead = !light.allocator.makes(); // another camera has other slices
  const bool shares = slice_choice::tellsShares(light);
  if (light.draws() > 1 || ahead) samples::fixUp(light, Pass::FixupAllTexels, options);
  if (shares && (light.draws() == 1 || ahead)) samples::fixUp(light, Pass::FixupByShares, options);
  if ((!shares && light.draws() == 1) || ahead) samples::fixUp(light, Pass::FixupAlongRow, options);
}

// Those pixels and the many between slices that disagree: along their own line or, behind what dims them before the
// eye, texel by texel.
void planBetweenSlices(LightPlanner& light) {
  if (light.variant.eyeCurves) return samples::fixUp(light, Pass::FixupAllTexels, {{}, kOnlyUnserved});
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    if (light.draws() > 1) rows::plan(light); // only the last draw's rows are at hand
    rows::planPairs(light);
    samples::fixUp(light, Pass::FixupOwnLine, {{}, kOnlyUnserved});
  }
}

// The tiles that hold a pixel to fix up.
gl::Uint planTiles(LightPlanner& light) {
  DrawOptions unserved{{}, kOnlyUnserved};
  unserved.clearTo = 0;
  light.draw(Pass::Unserved, unserved);
  light.draw(Pass::UnservedTiles);
  return light.board[Resource::UnservedTiles];
}

} // namespace

// Nothing of it waits for how many pixels there are to fix up: the stencil keeps the others, or tiles without any are
// not drawn (Tuning::fixup), of which the stencil keeps the others.
void plan(LightPlanner& light) {
  const bool spread = std::isfinite(light.frame.settings.spreadThreshold);
  const bool whole = light.drawnTiles == 0 && !light.drawsMarked; // else how many pixels are drawn is not known
  light.selectDraw(0);
  light.clearStencil();
  const bool sampled = light.extent.sampledDepth;
  Counting counting = whole && !sampled ? Counting{Count::Served, light.pixels()} : Counting{};
  light.draw(Pass::Unwarp, {{{"SPREAD", spread ? 1 : 0}}, sampled ? offEdges(kMarkServed) : kMarkServed, counting});
  if (sampled) samples::unwarpEdges(light); // apart, so that the stencil keeps other pixels from being shaded
  const gl::Uint tiles = light.drawnTiles;
  if (light.tuning.fixup == Masking::Tiles) light.drawnTiles = planTiles(light);
  if (spread)
    planBetweenSlices(light);
  else
    planUnserved(light, whole && !sampled ? Counting{} : Counting{Count::FixedUp});
  light.drawnTiles = tiles;
  if (sampled) samples::addEdges(light);
}

} // namespace tyndall::passes::unwarp
