#include "passes/Epipolar.h"

#include "History.h"
#include "passes/Changes.h"
#include "passes/Interpolate.h"
#include "passes/March.h"
#include "passes/MarchExtra.h"
#include "passes/MeanLight.h"
#include "passes/PixelTree.h"
#include "passes/Refine.h"
#include "passes/Rows.h"
#include "passes/Samples.h"
#include "passes/SliceView.h"
#include "passes/Unwarp.h"

#include <cmath>
#include <utility>

// One light. Boxes are passes, the rest are textures (Targets.cpp); [rows] and both marches run once for all shadow
// views, or for some at a time (SliceContext::draws).
//
//   light, camera --> [slices] --> slice table, which all passes read
//   shadow map, glass map --> [rows] --> row depths, row tree
//
//   Techniques tree and lowrank:
//                        scene depth, row depths, row tree --> [pixel tree] --> destination
//
//   Technique epipolar:  scene depth --> [samples] --> sample ends, marks
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

SliceContext contextOf(const PassContext& pass, Targets& targets, PassRecorder& recorder,
                       const gl::Framebuffer& scratch, const SliceInputs& inputs) {
  return {pass, targets, recorder, scratch, inputs};
}

Status makeSlices(SliceContext& context) {
  const SliceInputs& inputs = context.inputs;
  Targets& targets = inputs.history ? inputs.history->kept : context.targets;
  return slices::run(context.pass, targets, {inputs.frame, inputs.light, inputs.map}, context.slices);
}

// What the steps up to [interpolate] leave for those after it, and for the debug views.
struct Interpolated {
  samples::Out samples;
  rows::Out rows;
  gl::Uint refinedMarks = 0, inscatter = 0, mean = 0;
};

Status runToInterpolate(SliceContext& context, Interpolated& out) {
  march::Out marched;
  refine::Out refined;
  march_extra::Out extra;
  interpolate::Out interpolated;
  mean_light::Out mean;
  if (Status s = samples::runMarks(context, out.samples); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (context.draws() > 1) // else they are at hand
      if (Status s = rows::run(context, {draw}, out.rows); !s) return s;
    if (Status s = march::run(context, {draw, out.rows, out.samples.ends}, marched); !s) return s;
  }
  if (std::isfinite(context.inputs.frame->settings.spreadThreshold))
    if (Status s = mean_light::run(context, {marched.marched}, mean); !s) return s;
  if (Status s = refine::run(context, {out.samples.marks, marched.marched}, refined); !s) return s;
  for (int draw = 0; draw < context.draws(); ++draw) {
    if (context.draws() > 1) // only the last draw's rows are at hand
      if (Status s = rows::run(context, {draw}, out.rows); !s) return s;
    const march_extra::In in{draw, out.rows, out.samples.ends, refined.marks, refined.offsets};
    if (Status s = march_extra::run(context, in, extra); !s) return s;
  }
  const interpolate::In in{out.samples.ends, refined.marks, refined.offsets, marched.marched, extra};
  if (Status s = interpolate::run(context, in, interpolated); !s) return s;
  out.refinedMarks = refined.marks;
  out.inscatter = interpolated.inscatter;
  out.mean = mean.mean;
  return {};
}

Status runEpipolar(SliceContext& context) {
  Interpolated made;
  if (Status s = samples::runEnds(context, made.samples); !s) return s;
  if (context.draws() == 1)
    if (Status s = rows::run(context, {0}, made.rows); !s) return s;
  if (Status s = runToInterpolate(context, made); !s) return s;
  if (Status s = unwarp::run(context, {made.inscatter, made.mean, made.rows}); !s) return s;
  return slice_view::run(context, {made.samples.ends, made.samples.marks, made.refinedMarks});
}

Status runTree(SliceContext& context) {
  if (Status s = pixel_tree::run(context, {}); !s) return s;
  return slice_view::run(context, {});
}

// Sample ends and row depths of this frame beside the last one's, and what differs: of all slices, and the last frame's
// are then given up; or of those that objects reach, whose own are then copied over the last frame's.
Status makeAndCompare(SliceContext& context, Interpolated& made, int frame) {
  LightHistory& history = *context.inputs.history;
  const bool some = context.inputs.frame->reuse.changes == Changes::Objects;
  if (some)
    if (Status s = changes::findMoved(context, frame); !s) return s;
  const gl::Uint moved = context.changedSlices;
  history.movedSlices = moved;
  const bool ends = history.comparesEnds, rows = history.comparesRows;
  changes::In in{history.sampleEnds, 0, history.row, {}};
  const auto changeSides = [&] {
    if (ends) history.endsSide = 1 - history.endsSide;
    if (rows) history.rowsSide = 1 - history.rowsSide;
  };
  changeSides();
  if (ends) {
    if (Status s = samples::runEnds(context, made.samples); !s) return s;
    in.sampleEnds = made.samples.ends;
    in.lastSampleEnds = history.sampleEnds;
  }
  if (rows) {
    made.rows = {};
    if (Status s = rows::runDepths(context, {0, false, true}, made.rows); !s) return s;
    in.rows = made.rows;
    in.lastRows = history.row;
  }
  if (Status s = changes::compare(context, in, frame); !s) return s;
  if (some) {
    const gl::Uint changed = std::exchange(context.changedSlices, moved);
    changeSides();
    if (ends)
      if (Status s = samples::copyEnds(context, in.sampleEnds, made.samples); !s) return s;
    if (rows)
      if (Status s = rows::copyDepths(context, in.rows, made.rows); !s) return s;
    context.changedSlices = changed;
  }
  if (!ends) made.samples.ends = history.sampleEnds;
  if (!rows) made.rows = history.row;
  return rows ? rows::runTree(context, {0}, made.rows) : Status{};
}

// All of them; what the next frame compares with its own is kept, the rest of what was kept given up.
Status makeAll(SliceContext& context, Interpolated& made) {
  LightHistory& history = *context.inputs.history;
  history.segments = history.changed = context.slices.count * context.slices.samples / 16;
  if (Status s = samples::runEnds(context, made.samples); !s) return s;
  return context.draws() == 1 ? rows::run(context, {0, false, true}, made.rows) : Status{};
}

} // namespace

Status run(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
           const SliceInputs& inputs) {
  SliceContext context = contextOf(pass, targets, recorder, scratch, inputs);
  if (Status s = makeSlices(context); !s) return s;
  return inputs.frame->settings.technique == Technique::Epipolar ? runEpipolar(context) : runTree(context);
}

Status prepare(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
               const SliceInputs& inputs, int frame) {
  LightHistory& history = *inputs.history;
  if (history.redraw == Redraw::Nothing) {
    history.segments = history.geometry.count * history.geometry.samples / 16;
    recorder.skip(inputs.name, "nothing has changed: its slices are kept");
    return {};
  }
  SliceContext context = contextOf(pass, targets, recorder, scratch, inputs);
  Interpolated made;
  const bool all = history.redraw == Redraw::All;
  if (all) // what it does not ask for is given up when it is done
    for (Targets* kept : history.holders())
      kept->endFrame();
  if (Status s = makeSlices(context); !s) return s;
  if (context.draws() > 1) history.redraw = Redraw::All; // rows are not at hand together, nor kept
  Status prepared = history.redraw == Redraw::All ? makeAll(context, made) : makeAndCompare(context, made, frame);
  if (prepared) prepared = runToInterpolate(context, made);
  if (!prepared) return prepared;
  history.row = context.draws() == 1 ? made.rows : rows::Out{}; // else they are not the light's own
  history.sampleEnds = made.samples.ends;
  history.inscatter = made.inscatter;
  history.changedSlices = context.changedSlices;
  history.changedSegments = context.changedSegments;
  history.geometry = std::move(context.slices);
  for (Targets* kept : history.holders()) {
    if (all) kept->endFrame();
    kept->hold();
  }
  return {};
}

Status finish(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
              const SliceInputs& inputs) {
  const LightHistory& history = *inputs.history;
  SliceContext context = contextOf(pass, targets, recorder, scratch, inputs);
  context.slices = history.geometry;
  context.selectDraw(0);
  return unwarp::run(context, {history.inscatter, 0, history.row});
}

std::vector<gl::Variant> allVariants() {
  std::vector<gl::Variant> all = slice_view::allVariants();
  for (const gl::Variant& offsets : inSlices("passes/offsets.frag", {}, Along::Anything))
    all.push_back(offsets);
  for (const exact::Variant& variant : exact::allVariants()) {
    if (variant.multisampled || variant.lightKind == 3) continue;
    for (const gl::Variant& pixels : pixel_tree::variantsOf(variant))
      all.push_back(pixels);
    const gl::Definitions definitions = exact::definitionsOf(variant);
    const auto add = [&](const std::vector<gl::Variant>& some) { all.insert(all.end(), some.begin(), some.end()); };
    for (const char* fragment : {"sampleEnds", "marks", "march", "refine", "interpolate"})
      add(inSlices(("passes/" + std::string(fragment) + ".frag").c_str(), definitions,
                   std::string(fragment) == "march" ? Along::SegmentsAndOne : Along::Samples));
    add(inStrips("passes/marchExtra.frag", definitions));
    add(changes::variantsOf(variant));
    for (const gl::Variant& unwarped : unwarp::variantsOf(variant))
      all.push_back(unwarped);
    for (const gl::Variant& mean : mean_light::variantsOf(variant))
      all.push_back(mean);
    for (const gl::Variant& row : rows::variantsOf(variant))
      all.push_back(row);
  }
  return all;
}

} // namespace tyndall::passes::epipolar
