#include "reuse/Redrawing.h"

#include "optics/MovedSlices.h"
#include "passes/Epipolar.h"
#include "passes/Rows.h"

#include <algorithm>
#include <tuple>

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

constexpr std::size_t kTogether = 8; // slices that share what has changed, as in changedSlices.frag
constexpr int kGroup = 4;            // texels of a row that a fragment makes

optics::Range rangeOfEight(const std::vector<optics::Range>& ranges, std::size_t first, std::size_t count) {
  optics::Range all;
  for (std::size_t i = first; i < first + count; ++i)
    all = all | ranges[i];
  return all;
}

// The slices that Frame::objects reaches, and those due to be refreshed: only they are compared, and until then drawn;
// of them the segments whose ends, and of rows the parts whose texels, an object can have moved.
void findMoved(LightPlanner& light, const blocks::LightBlock& block) {
  optics::MovedSlices moved = optics::movedSlices(light.frame, light.light, block, light.geometry);
  const std::size_t slices = moved.moved.size(), views = moved.texels.size() / std::max<std::size_t>(slices, 1);
  for (int i = light.block.firstRefreshedSlice; i < light.block.endRefreshedSlice; ++i) {
    const auto slice = static_cast<std::size_t>(i);
    moved.moved[slice] = true;
    moved.samples[slice] = {0, light.extent.samples};
    for (std::size_t v = 0; v < views; ++v)
      moved.texels[v * slices + slice] = {0, light.extent.drawnTexels};
  }
  const int segments = light.extent.samples / kSegmentSamples;
  const bool wholeRows = light.extent.drawnTexels % kPartTexels != 0; // of small maps
  std::vector<glm::vec4> texels(slices * (1 + views), glm::vec4(0)), ends(slices, glm::vec4(0));
  for (std::size_t i = 0; i < slices; i += kTogether) {
    const std::size_t together = std::min(kTogether, slices - i);
    const auto begin = moved.moved.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::none_of(begin, begin + static_cast<std::ptrdiff_t>(together), [](bool m) { return m; })) continue;
    const auto fill = [&](std::vector<glm::vec4>& to, std::size_t first, const glm::vec4& value) {
      std::fill_n(to.begin() + static_cast<std::ptrdiff_t>(first), together, value);
    };
    fill(texels, i, {0, segments, 1, 1});
    const optics::Range samples = rangeOfEight(moved.samples, i, together);
    if (!samples.isEmpty())
      fill(ends, i, {samples.begin / kSegmentSamples, unitsFor(samples.end, kSegmentSamples), 0, 0});
    for (std::size_t v = 0; v < views; ++v) {
      const optics::Range range = rangeOfEight(moved.texels, v * slices + i, together);
      if (range.isEmpty()) continue;
      const auto length = static_cast<float>(light.extent.drawnTexels);
      const int first = range.begin / kPartTexels * kPartTexels, last = roundedUp(range.end, kPartTexels);
      fill(texels, (1 + v) * slices + i,
           wholeRows ? glm::vec4(0, length, 0, length)
                     : glm::vec4(first, last, range.begin / kGroup * kGroup, roundedUp(range.end, kGroup)));
    }
  }
  light.upload(R::MovedSlices, std::move(texels));
  light.upload(R::MovedEnds, std::move(ends));
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
  light.drawnSlices = light.board[R::MovedEnds];
  if (ends) light.draw(Pass::ChangedEnds, clearedTo(0));
  light.drawnSlices = light.board[R::MovedSlices];
  DrawOptions segments = clearedTo(0);
  frame.count.segments += static_cast<std::uint64_t>(light.segments());
  if (frame.counts) {
    segments.counting = {Count::Into, 0, &frame.eye.counts.unusedQuery()};
    frame.count.queries.push_back(segments.counting.query);
  }
  light.draw(Pass::ChangedSegments, segments);
  light.draw(Pass::ChangedSlices, clearedTo(0));
}

// Sample ends of this frame beside the last one's: of all, in the other texture of two; or of those that objects can
// have moved, which are drawn over the last frame's once these have been copied.
void drawEnds(LightPlanner& light, const KeptSlices& last, bool objects) {
  light.drawnSlices = light.board[R::MovedEnds];
  light.endsSide = 1 - last.endsSide;
  if (objects) {
    light.board[R::Image] = light.board[R::SampleEnds];
    light.draw(Pass::KeepEnds);
  }
  light.board[R::LastSampleEnds] = light.board[R::SampleEnds];
  if (objects) light.endsSide = last.endsSide;
  light.draw(Pass::SampleEnds, {{{"KEEPS_ENDS", 1}}});
}

// The same of row depths, and of what else tells a change of them.
void drawRows(LightPlanner& light, const KeptSlices& last, bool objects) {
  light.drawnSlices = light.board[R::MovedSlices];
  light.rowsSide = 1 - last.rowsSide;
  light.extent.hashes = light.extent.shares;
  for (const auto& [pass, resource, kept] : {std::tuple(Pass::KeepRows, R::RowDepths, R::LastRowDepths),
                                             std::tuple(Pass::KeepHashes, R::RowHashes, R::LastRowHashes)}) {
    if (resource == R::RowHashes && !light.extent.hashes) continue;
    if (objects) {
      light.board[R::Image] = light.board[resource];
      light.draw(pass);
    }
    light.board[kept] = light.board[resource];
  }
  if (objects) light.rowsSide = last.rowsSide;
  passes::rows::planDepths(light, passes::rows::Walk::Lit, true);
}

// Sample ends and row depths of this frame beside the last one's, and what differs.
void planChanged(LightPlanner& light, const KeptSlices& last, const LightRedraw& redraw, Redrawing& frame) {
  const bool objects = light.frame.reuse.changes == Changes::Objects;
  takeKept(light, last);
  refresh(light, frame.eye.frames);
  light.block.comparesEnds = redraw.comparesEnds ? 1 : 0;
  light.block.comparesRows = redraw.comparesRows ? 1 : 0;
  light.block.keepsEnds = redraw.mixesEnds ? 1 : 0;
  light.selectDraw(0);
  if (objects) findMoved(light, last.key.block);
  if (redraw.comparesEnds) drawEnds(light, last, objects);
  if (redraw.comparesRows) drawRows(light, last, objects);
  compare(light, redraw, frame);
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
