#include "passes/Changes.h"

#include "History.h"
#include "optics/MovedSlices.h"
#include "passes/StencilTest.h"

#include <algorithm>

namespace tyndall::passes::changes {

namespace {

constexpr const char* kSlices = "passes/changedSlices.frag";
constexpr int kParts = 32; // of a slice

gl::Definitions comparing(gl::Definitions definitions, bool ends, bool rows) {
  definitions.emplace_back("ENDS", ends ? 1 : 0);
  definitions.emplace_back("ROWS", rows ? 1 : 0);
  return definitions;
}

gl::Definitions folding(gl::Definitions definitions) {
  definitions.emplace_back("FOLD", 1);
  return definitions;
}

gl::Definitions masking(const exact::Variant& variant, bool comparesDepth) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("COMPARES_DEPTH", comparesDepth ? 1 : 0);
  return definitions;
}

// The slices of a frame in Reuse::refreshFrames.
glm::ivec4 refreshed(const SliceContext& context, int frame) {
  const std::int64_t period = context.inputs.frame->reuse.refreshFrames, slices = context.slices.count;
  if (period == 0) return glm::ivec4(0);
  const std::int64_t turn = frame % period;
  return {static_cast<int>(slices * turn / period), static_cast<int>(slices * (turn + 1) / period), 0, 0};
}

} // namespace

Status findMoved(SliceContext& context, int frame) {
  const SliceInputs& in = context.inputs;
  LightHistory& history = *in.history;
  const glm::ivec4 refresh = refreshed(context, frame);
  std::vector<bool> moved = optics::movedSlices(*in.frame, *in.light, history.key.block, context.slices.geometry);
  std::fill(moved.begin() + refresh.x, moved.begin() + refresh.y, true);
  history.slices = context.slices.count;
  history.changed = static_cast<int>(std::count(moved.begin(), moved.end(), true));
  if (static_cast<float>(history.changed) > in.frame->reuse.fullShare * static_cast<float>(history.slices)) {
    history.redraw = Redraw::All;
    history.changed = history.slices;
    return {};
  }
  std::vector<glm::vec4> texels(moved.size());
  std::transform(moved.begin(), moved.end(), texels.begin(), [](bool m) { return glm::vec4(m ? 1.0F : 0.0F); });
  return slices::uploadTable(context.pass, history.kept, Target::ChangedSlices, context.slices.count, 1, texels,
                             context.changed);
}

Status compare(SliceContext& context, const In& in, int frame) {
  LightHistory& history = *context.inputs.history;
  gl::Uint parts = 0;
  context.slices.block.refresh = refreshed(context, frame);
  context.selectDraw(0);
  context.bindSlices();
  if (in.lastSampleEnds) {
    context.bind(gl::Unit::SampleEnds, in.sampleEnds);
    context.bind(gl::Unit::LastSampleEnds, in.lastSampleEnds);
  }
  if (in.lastRows) {
    context.bind(gl::Unit::RowStates, in.rows);
    context.bind(gl::Unit::LastRowStates, in.lastRows);
  }
  setBlend(context.pass, Blend::Replace);
  if (Status s = context.target(Target::ChangedParts, context.slices.count, kParts, parts); !s) return s;
  if (Status s =
          context.draw("changes", kSlices, comparing(context.definitions, in.lastSampleEnds != 0, in.lastRows != 0));
      !s)
    return s;
  context.bind(gl::Unit::ChangedParts, parts);
  if (Status s = context.target(Target::ChangedSlices, context.slices.count, 1, context.changed); !s) return s;
  constexpr std::array<gl::Float, 4> kNone = {0, 0, 0, 0};
  context.gl.ClearBufferfv(gl::COLOR, 0, kNone.data());
  history.slices = context.slices.count;
  history.count = gl::Query(context.gl);
  history.changed = -1;
  Status status;
  if (!context.recorder.countInto(
          history.count, [&] { status = context.draw("changed slices", kSlices, folding(context.definitions)); }))
    history.changed = 0; // a query of the engine's own is under way: not known
  return status;
}

bool mask(const PassContext& context, const exact::Variant& variant, bool comparesDepth) {
  context.gl.StencilMask(0xFF);
  // Each pixel once, whichever light changes it: the writes are counted.
  const StencilTest test(context.gl, {gl::NOTEQUAL, kMasked, kMasked, gl::REPLACE});
  return drawFullScreen(context, "passes/mask.frag", masking(variant, comparesDepth));
}

bool keepDepth(const PassContext& context, bool underMask) {
  const gl::Definitions definitions = {{"DEPTH_MULTISAMPLED", 0}};
  if (!underMask) return drawFullScreen(context, "passes/keepDepth.frag", definitions);
  const StencilTest test(context.gl, {gl::EQUAL, kMasked, kMasked, gl::KEEP});
  return drawFullScreen(context, "passes/keepDepth.frag", definitions);
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  const gl::Definitions definitions = exact::definitionsOf(variant);
  std::vector<gl::Variant> all = {{kSlices, folding(definitions)},
                                  {kSlices, comparing(definitions, true, false)},
                                  {kSlices, comparing(definitions, false, true)},
                                  {kSlices, comparing(definitions, true, true)},
                                  {"passes/mask.frag", masking(variant, false)},
                                  {"passes/mask.frag", masking(variant, true)}};
  if (variant.shadowViews == 0) {
    all.erase(all.begin() + 2, all.begin() + 4);
  }
  return all;
}

} // namespace tyndall::passes::changes
