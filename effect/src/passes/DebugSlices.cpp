#include "passes/DebugSlices.h"

#include "passes/PixelTree.h"

namespace tyndall::passes::debug_slices {

namespace {

// The samples that a view shows, as colours that add up in their pixels.
void planSamples(LightPlanner& light, int shown) {
  light.block.shownSamples = shown;
  light.selectDraw(0);
  light.draw(Pass::DebugSamples);
}

} // namespace

void plan(LightPlanner& light, DebugView view) {
  switch (view) {
  case DebugView::Slices:
    return light.draw(Pass::DebugSlices);
  case DebugView::Samples:
    return planSamples(light, 0);
  case DebugView::Breaks:
    return planSamples(light, 1);
  case DebugView::MarchSamples:
    return planSamples(light, 2);
  case DebugView::FixupPixels:
    return light.draw(Pass::DebugFixup, {{}, kOnlyUnserved});
  case DebugView::NodeVisits:
    return pixel_tree::planVisits(light);
  default:
    return;
  }
}

} // namespace tyndall::passes::debug_slices
