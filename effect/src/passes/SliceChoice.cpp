#include "passes/SliceChoice.h"

#include "passes/Rows.h"

#include <algorithm>

// A preview, of every eighth slice and coarser along them, tells how much light changes from slice to slice, and where.
// Nothing waits for it: columns that are not used are drawn without a fragment, as by temporal reuse.
//
//   candidates --> preview: [sample ends], [rows], [march], [mean light], [slice errors]
//   slice errors --> [slice spacing], [slice budget], [slice blocks] --> slice blocks
//   candidate table, slice blocks --> [drawn slices] --> slice table, changed slices, changed segments
//   slice spacing, slice blocks --> [slice estimate], for the statistics
//
namespace tyndall::passes::slice_choice {

namespace {

constexpr int kFewerSamples = 2, kLongerSteps = 4;

optics::SliceSampling previewOf(const Settings& settings) {
  return {SLICE_BLOCK, std::max(settings.samples / kFewerSamples / 64 * 64, 64),
          std::min(settings.rowStep * kLongerSteps, 8)};
}

// Leaves slice errors and mean light.
void planPreview(LightPlanner& light) {
  light.name += " preview";
  light.makeSlices(previewOf(light.frame.settings));
  light.selectDraw(0);
  light.draw(Pass::SampleEnds, {{{"KEEPS_ENDS", 0}}});
  for (int draw = 0; draw < light.draws(); ++draw) {
    light.selectDraw(draw);
    rows::plan(light);
    light.draw(Pass::March);
  }
  light.plan.marched += light.regularSamples * static_cast<std::uint64_t>(light.draws());
  light.draw(Pass::SliceSums);
  light.draw(Pass::MeanLight);
  light.draw(Pass::SliceErrors);
}

void planEstimate(LightPlanner& light) {
  light.draw(Pass::SliceEstimate);
  light.draw(Pass::CountEstimate, {{{"ESTIMATE", 2}}, {}, {Count::Estimate}});
  light.draw(Pass::CountEstimate, {{{"ESTIMATE", 3}}, {}, {Count::OverTarget}});
}

} // namespace

bool isMade(const LightPlanner& light) {
  const bool ahead = !light.allocator.makes();
  return light.block.sliceTarget > 0 || (ahead && optics::mayChooseSlices(light.frame));
}

void plan(LightPlanner& light) {
  LightPlanner preview(light);
  planPreview(preview);
  light.board[Resource::SliceErrors] = preview.board[Resource::SliceErrors];
  light.board[Resource::MeanLight] = preview.board[Resource::MeanLight];
  light.selectDraw(0);
  light.draw(Pass::SliceSpacing);
  light.draw(Pass::SliceBudget);
  light.draw(Pass::SliceBlocks);
  light.draw(Pass::DrawnSlices);
  DrawOptions columns{{}, {}, {Count::Slices}};
  columns.clearTo = 0;
  light.draw(Pass::DrawnColumns, columns);
  DrawOptions segments{{}, {}, {Count::Marched, static_cast<std::uint64_t>(light.draws())}};
  segments.clearTo = 0;
  light.draw(Pass::DrawnSegments, segments);
  planEstimate(light);
  light.drawnSlices = light.board[Resource::ChangedSlices];
  light.drawnSegments = light.board[Resource::ChangedSegments];
}

bool tellsShares(const LightPlanner& light) {
  return isMade(light) && light.light.kind == LightKind::Directional && !light.light.boundary.enabled &&
         light.variant.layers == kNoLayers && !light.variant.eyeCurves;
}

} // namespace tyndall::passes::slice_choice
