#include "passes/Unwarp.h"

#include "passes/Rows.h"

#include <cmath>

namespace tyndall::passes::unwarp {

namespace {

// The few pixels that no sample serves: along their slice's row. With several draws only the last one's rows are at
// hand, and to make them all again would take longer than every texel does.
void planUnserved(LightPlanner& light, const Counting& counting) {
  const DrawOptions options{{}, Stencil::OnlyUnserved, counting};
  const bool ahead = !light.allocator.makes(); // another camera has other slices
  if (light.draws() > 1 || ahead) light.drawLight(Pass::FixupAllTexels, options);
  if (light.draws() == 1 || ahead) light.drawLight(Pass::FixupAlongRow, options);
}

// Those pixels and the many between slices that disagree: along their own line.
void planBetweenSlices(LightPlanner& light) {
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    if (light.draws() > 1) rows::plan(light); // only the last draw's rows are at hand
    rows::planPairs(light);
    light.drawLight(Pass::FixupOwnLine, {{}, Stencil::OnlyUnserved});
  }
}

} // namespace

// Nothing of it waits for how many pixels there are to fix up: the stencil keeps the others.
void plan(LightPlanner& light) {
  const bool spread = std::isfinite(light.frame.settings.spreadThreshold);
  light.selectDraw(0);
  light.clearStencil();
  const bool tiles = light.drawnTiles != 0; // how many pixels they have is not known
  light.draw(Pass::Unwarp, {{{"SPREAD", spread ? 1 : 0}},
                            Stencil::MarkServed,
                            tiles ? Counting{} : Counting{Count::Served, light.pixels()}});
  if (spread)
    planBetweenSlices(light);
  else
    planUnserved(light, tiles ? Counting{Count::FixedUp} : Counting{});
}

} // namespace tyndall::passes::unwarp
