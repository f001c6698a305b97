#include "reuse/Redrawing.h"

#include "optics/MovedSlices.h"
#include "passes/Epipolar.h"
#include "passes/Rows.h"

#include <algorithm>

namespace tyndall::reuse {

namespace {

using R = Resource;

// Those of the light's own textures that the last frame left.
void takeKept(LightPlanner& light, const KeptSlices& last) {
  for (const R resource : {R::SliceTable, R::SampleEnds, R::Marched, R::EpipolarInscatter, R::RowDepths, R::RowShares,
                           R::RowHashes, R::RowTree, R::RowMeans, R::RowMoments, R::CurveCells, R::CurveTree})
    light.board[resource] = last.board[resource];
  light.endsSide = last.endsSide;
  light.rowsSide = last.rowsSide;
}

// The slices that are due in this frame (Reuse::refreshFrames).
void refresh(LightPlanner& light, int frame) {
  const std::int64_t period = light.frame.reuse.refreshFrames, slices = light.extent.slices;
  if (period == 0) return;
  const std::int64_t turn = frame % period;
  light.block.firstRefreshedSlice = static_cast<int>(slices * turn / period);
  light.block.endRefreshedSlice = static_cast<int>(slices * (turn + 1) / period);
}

// The slices that Frame::objects reaches, and those due to be refreshed: only they are compared, and until then drawn.
void findMoved(LightPlanner& light, const blocks::LightBlock& block) {
  std::vector<bool> moved = optics::movedSlices(light.frame, light.light, block, light.geometry);
  std::fill(moved.begin() + light.block.firstRefreshedSlice, moved.begin() + light.block.endRefreshedSlice, true);
  for (std::size_t i = 0; i < moved.size(); i += 8) { // as changedSlices.frag has them: of eight slices
    const auto begin = moved.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = moved.begin() + static_cast<std::ptrdiff_t>(std::min(i + 8, moved.size()));
    std::fill(begin, end, std::find(begin, end, true) != end);
  }
  std::vector<glm::vec4> texels(moved.size(), glm::vec4(0));
  const int segments = light.extent.samples / kSegmentSamples;
  std::transform(moved.begin(), moved.end(), texels.begin(),
                 [&](bool m) { return m ? glm::vec4(0, segments, 1, 1) : glm::vec4(0); });
  light.upload(R::MovedSlices, std::move(texels));
  light.drawnSlices = light.board[R::MovedSlices];
}

// From sample ends and row depths of both frames, those that there are, to the segments and slices that have changed.
void compare(LightPlanner& light, const LightRedraw& redraw, Redrawing& frame) {
  const bool ends = redraw.comparesEnds, rows = redraw.comparesRows;
  const auto clearedTo = [](float value, gl::Definitions options = {}) {
    DrawOptions draw{std::move(options)};
    draw.clearTo = value;
    return draw;
  };
  if (rows)
    light.draw(Pass::ChangedParts, clearedTo(1, light.extent.hashes ? gl::Definitions{{"ROW_HASHES", 1}}
                                                                    : gl::Definitions{})); // 1: nothing
  if (ends) light.draw(Pass::ChangedEnds, clearedTo(0));
  DrawOptions segments = clearedTo(0);
  frame.count.segments += static_cast<std::uint64_t>(light.segments());
  if (frame.counts) {
    segments.counting = {Count::Into, 0, &frame.eye.counts.unusedQuery()};
    frame.count.queries.push_back(segments.counting.query);
  }
  light.draw(Pass::ChangedSegments, segments);
  light.draw(Pass::ChangedSlices, clearedTo(0));
}

// What was compared of the slices that objects reach is copied over the last frame's.
void keepMoved(LightPlanner& light, const KeptSlices& last, const LightRedraw& redraw) {
  light.endsSide = last.endsSide;
  light.rowsSide = last.rowsSide;
  const auto keep = [&light](Pass pass, R resource) {
    light.board[R::Image] = light.board[resource];
    light.draw(pass);
  };
  if (redraw.comparesEnds) keep(Pass::KeepEnds, R::SampleEnds);
  if (!redraw.comparesRows) return;
  keep(Pass::KeepRows, R::RowDepths);
  if (light.extent.shares) keep(Pass::KeepShares, R::RowShares);
  if (light.extent.hashes) keep(Pass::KeepHashes, R::RowHashes);
}

// Sample ends and row depths of this frame beside the last one's, and what differs: of all slices, and the last frame's
// are then given up; or of those that objects reach.
void planChanged(LightPlanner& light, const KeptSlices& last, const LightRedraw& redraw, Redrawing& frame) {
  const bool objects = light.frame.reuse.changes == Changes::Objects;
  takeKept(light, last);
  refresh(light, frame.eye.frames);
  light.block.comparesEnds = redraw.comparesEnds ? 1 : 0;
  light.block.comparesRows = redraw.comparesRows ? 1 : 0;
  light.block.keepsEnds = redraw.mixesEnds ? 1 : 0;
  light.selectDraw(0);
  if (objects) findMoved(light, last.key.block);
  if (redraw.comparesEnds) {
    light.board[R::LastSampleEnds] = light.board[R::SampleEnds];
    light.endsSide = 1 - last.endsSide;
    light.draw(Pass::SampleEnds, {{{"KEEPS_ENDS", 1}}});
  }
  if (redraw.comparesRows) {
    light.board[R::LastRowDepths] = light.board[R::RowDepths];
    light.board[R::LastRowHashes] = light.board[R::RowHashes];
    light.rowsSide = 1 - last.rowsSide;
    passes::rows::planDepths(light, passes::rows::Walk::Lit, true);
  }
  compare(light, redraw, frame);
  if (objects) keepMoved(light, last, redraw);
  light.drawnSlices = light.board[R::ChangedSlices];
  light.drawnSegments = light.board[R::ChangedSegments];
  if (redraw.comparesRows) passes::rows::planTree(light, passes::rows::Walk::Lit);
}

// True if the last frame left copies of the same maps.
bool hasCopies(const LightPlanner& light, const LightRedraw& redraw, const KeptLight& kept) {
  return light.frame.reuse.changes == Changes::Detect && kept.last && isStated(redraw.maps, kept.last->maps) &&
         sameCopies(redraw.key, kept.last->key);
}

void planAll(LightPlanner& light, Redrawing& frame) {
  const auto segments = static_cast<std::uint64_t>(light.segments());
  frame.count.segments += segments;
  frame.count.changed += segments;
  light.selectDraw(0);
  light.draw(Pass::SampleEnds, {{{"KEEPS_ENDS", 0}}});
  if (light.draws() > 1) return;
  passes::rows::planDepths(light, passes::rows::Walk::Lit, true);
  passes::rows::planTree(light, passes::rows::Walk::Lit);
}

} // namespace

void planSlices(LightPlanner& light, LightRedraw& redraw, Redrawing& frame) {
  KeptLight& kept = *frame.eye.lights[redraw.index];
  light.keptTargets = &kept.targets;
  if (redraw.redraw == Redraw::Nothing && kept.last) {
    takeKept(light, *kept.last);
    light.takeCopies(kept.last->board);
    const Extent now = light.extent;
    light.extent = kept.last->extent;
    light.extent.lookup = now.lookup;
    light.extent.lookupDepths = now.lookupDepths;
    light.block = kept.last->block;
    light.viewsPerDraw = kept.last->viewsPerDraw;
    frame.count.segments += static_cast<std::uint64_t>(light.segments());
    light.plan.skip(light.name, "nothing has changed: its slices are kept");
    return;
  }
  light.copyMaps(kept.last && hasCopies(light, redraw, kept) ? &kept.last->board : nullptr);
  light.makeSlices();
  if (light.draws() > 1) redraw.redraw = Redraw::All; // rows are not at hand together, nor kept
  if (redraw.redraw == Redraw::All || !kept.last)
    planAll(light, frame);
  else
    planChanged(light, *kept.last, redraw, frame);
  passes::epipolar::planToInterpolate(light);
}

KeptSlices keptOf(const LightPlanner& light, const LightRedraw& redraw) {
  return {redraw.key,     redraw.maps,    light.board,
          light.extent,   light.block,    light.viewsPerDraw,
          light.endsSide, light.rowsSide, redraw.redraw != Redraw::All && redraw.mixesEnds};
}

void planMask(LightPlanner& light, bool comparesDepth, bool begins) {
  DrawOptions options;
  light.block.comparesDepth = comparesDepth ? 1 : 0;
  light.block.comparesSome = light.board[R::MovedSlices] ? 1 : 0;
  light.selectDraw(0);
  if (light.tuning.reuse == Masking::Stencil) {
    if (begins) light.clearStencil();
    options.stencil = kMarkChanged;
    options.blend = Blend::Add;
    return light.draw(Pass::ChangedPixels, options);
  }
  if (begins) options.clearTo = 0;
  light.draw(Pass::ChangedTiles, options);
}

} // namespace tyndall::reuse
