#include "passes/Changes.h"

#include "History.h"
#include "optics/MovedSlices.h"

#include <algorithm>
#include <array>

namespace tyndall::passes::changes {

namespace {

constexpr const char* kEnds = "passes/changedEnds.frag";
constexpr const char* kParts = "passes/changedParts.frag";
constexpr const char* kSegments = "passes/changedSegments.frag";
constexpr const char* kSlices = "passes/changedSlices.frag";
constexpr const char* kTiles = "passes/changedTiles.frag";
constexpr int kPartTexels = 256;

gl::Definitions comparing(gl::Definitions definitions, bool ends, bool rows) {
  definitions.emplace_back("ENDS", ends ? 1 : 0);
  definitions.emplace_back("ROWS", rows ? 1 : 0);
  return definitions;
}

gl::Definitions hashed(gl::Definitions definitions) {
  definitions.emplace_back("ROW_HASHES", 1);
  return definitions;
}

gl::Definitions tiling(const exact::Variant& variant, bool comparesDepth, bool some) {
  gl::Definitions definitions = exact::definitionsOf(variant);
  definitions.emplace_back("COMPARES_DEPTH", comparesDepth ? 1 : 0);
  definitions.emplace_back("SOME", some ? 1 : 0);
  return definitions;
}

// The slices of a frame in Reuse::refreshFrames.
glm::ivec4 refreshed(const SliceContext& context, int frame) {
  const std::int64_t period = context.inputs.frame->reuse.refreshFrames, slices = context.slices.count;
  if (period == 0) return glm::ivec4(0);
  const std::int64_t turn = frame % period;
  return {static_cast<int>(slices * turn / period), static_cast<int>(slices * (turn + 1) / period), 0, 0};
}

// Clears the target that was made last.
void clear(const SliceContext& context, float red) {
  const std::array<gl::Float, 4> colour = {red, 0, 0, 0};
  context.gl.ClearBufferfv(gl::COLOR, 0, colour.data());
}

Status compareRows(SliceContext& context, const In& in, gl::Uint& parts) {
  const bool hasHashes = in.rows.hashes != 0;
  context.bind(gl::Unit::RowDepths, in.rows.depths);
  context.bind(gl::Unit::LastRowDepths, in.lastRows.depths);
  if (hasHashes) {
    context.bind(gl::Unit::RowHashes, in.rows.hashes);
    context.bind(gl::Unit::LastRowHashes, in.lastRows.hashes);
  }
  const int width = (context.slices.rowTexels + kPartTexels - 1) / kPartTexels;
  if (Status s = context.target(Target::ChangedParts, width, context.rowRoom(), parts); !s) return s;
  clear(context, 1); // nothing
  context.gl.Viewport(0, 0, width, context.rows());
  return context.drawRows("changed parts", kParts, hasHashes ? hashed(context.definitions) : context.definitions);
}

} // namespace

Status findMoved(SliceContext& context, int frame) {
  const SliceInputs& in = context.inputs;
  const glm::ivec4 refresh = refreshed(context, frame);
  std::vector<bool> moved;
  context.recorder.run("moved slices", [&] {
    moved = optics::movedSlices(*in.frame, *in.light, in.history->key.block, context.slices.geometry);
    return true;
  });
  std::fill(moved.begin() + refresh.x, moved.begin() + refresh.y, true);
  for (std::size_t i = 0; i < moved.size(); i += 8) { // as changedSlices.frag has them: of eight slices
    const auto begin = moved.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = moved.begin() + static_cast<std::ptrdiff_t>(std::min(i + 8, moved.size()));
    std::fill(begin, end, std::find(begin, end, true) != end);
  }
  std::vector<glm::vec4> texels(moved.size(), glm::vec4(0));
  const int segments = context.slices.samples / 16;
  std::transform(moved.begin(), moved.end(), texels.begin(),
                 [&](bool m) { return m ? glm::vec4(0, static_cast<float>(segments), 1, 1) : glm::vec4(0); });
  return slices::uploadTable(context.pass, in.history->kept, Target::MovedSlices, context.slices.count, 1, texels,
                             context.changedSlices);
}

Status compare(SliceContext& context, const In& in, int frame) {
  LightHistory& history = *context.inputs.history;
  const bool ends = in.lastSampleEnds != 0, rows = in.lastRows.depths != 0;
  const gl::Definitions definitions = comparing(context.definitions, ends, rows);
  gl::Uint parts = 0, segments = 0, slices = 0;
  context.slices.block.refresh = refreshed(context, frame);
  context.selectDraw(0);
  context.bindSlices();
  setBlend(context.pass, Blend::Replace);
  if (rows)
    if (Status s = compareRows(context, in, parts); !s) return s;
  context.bind(gl::Unit::SampleEnds, in.sampleEnds);
  const int count = context.slices.count, along = context.slices.samples / 16;
  if (ends) {
    gl::Uint changedEnds = 0;
    context.bind(gl::Unit::LastSampleEnds, in.lastSampleEnds);
    if (Status s = context.target(Target::ChangedEnds, count, along, changedEnds); !s) return s;
    clear(context, 0);
    if (Status s = context.drawSlices("changed ends", kEnds, {}); !s) return s;
    context.bind(gl::Unit::ChangedEnds, changedEnds);
  }
  if (rows) context.bind(gl::Unit::ChangedParts, parts);
  if (Status s = context.target(Target::ChangedSegments, count, along, segments); !s) return s;
  clear(context, 0);
  history.segments = count * along;
  history.count = gl::Query(context.gl);
  history.changed = -1;
  Status drawn;
  if (!context.recorder.countInto(history.count,
                                  [&] { drawn = context.drawSlices("changed segments", kSegments, definitions); }))
    history.changed = 0; // a query of the engine's own is under way: not known
  if (!drawn) return drawn;
  context.bind(gl::Unit::ChangedSegments, segments);
  if (Status s = context.target(Target::ChangedSlices, count, 1, slices); !s) return s;
  clear(context, 0);
  if (Status s = context.drawSlices("changed slices", kSlices, definitions, Along::Anything); !s) return s;
  context.changedSegments = segments;
  context.changedSlices = slices;
  return {};
}

int tilesOf(int width, int height) { return ((width + kTile - 1) / kTile) * ((height + kTile - 1) / kTile); }

bool findTiles(const PassContext& context, const exact::Variant& variant, bool comparesDepth, bool some) {
  setBlend(context, Blend::Replace);
  return drawFullScreen(context, kTiles, tiling(variant, comparesDepth, some));
}

gl::Variant overTiles(gl::Variant fullScreen) {
  fullScreen.vertex = "passes/tiles.vert";
  return fullScreen;
}

bool drawTiles(const PassContext& context, const gl::Variant& fullScreen, int width, int height) {
  return drawStrips(context, overTiles(fullScreen), tilesOf(width, height), 1);
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  const gl::Definitions definitions = exact::definitionsOf(variant);
  std::vector<gl::Variant> all;
  for (const bool depth : {false, true})
    for (const bool some : {false, true})
      all.push_back({kTiles, tiling(variant, depth, some)});
  const auto add = [&](const std::vector<gl::Variant>& some) { all.insert(all.end(), some.begin(), some.end()); };
  const bool hasRows = variant.shadowViews > 0, hasHashes = variant.glass || variant.bilinear;
  if (hasRows) add(inRows(kParts, hasHashes ? hashed(definitions) : definitions));
  for (const bool ends : {false, true})
    for (const bool rows : {false, true}) {
      if (rows && !hasRows) continue;
      add(inSlices(kSegments, comparing(definitions, ends, rows)));
      add(inSlices(kSlices, comparing(definitions, ends, rows), Along::Anything));
    }
  add(inSlices(kEnds, {}));
  for (const Along along : {Along::Samples, Along::Rows})
    all.push_back(inSlices("passes/copyTexels.frag", {}, along)[1]);
  return all;
}

} // namespace tyndall::passes::changes
