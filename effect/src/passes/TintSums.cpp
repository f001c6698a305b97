#include "passes/TintSums.h"

#include <array>

namespace tyndall::passes::tint_sums {

namespace {

constexpr const char* kGroups = "passes/tintGroups.frag";
constexpr const char* kSums = "passes/tintSums.frag";
constexpr int kFewGroups = 16; // that are summed one by one: no level above them

using Level = std::array<gl::Uint, 3>; // a texture a channel
constexpr std::array<Target, 3> kGroupTargets = {Target::TintRed, Target::TintGreen, Target::TintBlue};
constexpr std::array<Target, 3> kSumTargets = {Target::TintSumsRed, Target::TintSumsGreen, Target::TintSumsBlue};
constexpr std::array<gl::Unit, 3> kUnits = {gl::Unit::TintRed, gl::Unit::TintGreen, gl::Unit::TintBlue};
constexpr std::array<gl::Unit, 3> kCoarserUnits = {gl::Unit::CoarserRed, gl::Unit::CoarserGreen, gl::Unit::CoarserBlue};

gl::Definitions folding() { return {{"FOLD", 1}}; }
gl::Definitions summing(bool coarser) { return coarser ? gl::Definitions{{"COARSER", 1}} : gl::Definitions{}; }

// Makes a level's textures the target; drawn are the groups of this frame's rows. Level 0 has one for four texels.
Status target(SliceContext& context, const std::array<Target, 3>& which, int index, Level& level) {
  const int width = context.slices.rowTexels >> (2 * index + 2), drawn = context.slices.block.grid.z >> (2 * index + 2);
  const int fours = (context.inputs.frame->settings.lowRankTerms + 3) / 4, height = fours * context.rowRoom();
  if (Status s = context.target(which[0], width, height, level[0]); !s) return s;
  for (gl::Enum i = 1; i < 3; ++i)
    if (Status s = context.attachMore(i, which[i], width, height, level[i]); !s) return s;
  context.gl.Viewport(0, 0, drawn, height);
  return {};
}

void bindLevel(const SliceContext& context, const std::array<gl::Unit, 3>& units, const Level& level) {
  for (std::size_t i = 0; i < 3; ++i)
    context.bind(units[i], level[i]);
}

Status makeSums(SliceContext& context) {
  // Up: every level the sums of four of the one below; down: the sums up to each group.
  std::vector<Level> levels(1);
  if (Status s = target(context, kGroupTargets, 0, levels[0]); !s) return s;
  if (Status s = context.draw("tint groups", kGroups, context.definitions); !s) return s;
  for (int level = 1; context.slices.rowTexels >> (2 * level) > kFewGroups; ++level) {
    bindLevel(context, kUnits, levels.back());
    levels.emplace_back();
    if (Status s = target(context, kGroupTargets, level, levels.back()); !s) return s;
    if (Status s = context.draw("tint fold", kSums, folding()); !s) return s;
  }
  Level sums{};
  const int top = static_cast<int>(levels.size()) - 1;
  for (int level = top; level >= 0; --level) {
    bindLevel(context, kUnits, levels[static_cast<std::size_t>(level)]);
    if (level < top) bindLevel(context, kCoarserUnits, sums);
    if (Status s = target(context, kSumTargets, level, sums); !s) return s;
    if (Status s = context.draw("tint sums", kSums, summing(level < top)); !s) return s;
  }
  bindLevel(context, kUnits, sums);
  return {};
}

} // namespace

Status run(SliceContext& context, const In& in) {
  setBlend(context.pass, Blend::Replace);
  context.bind(gl::Unit::RowDepths, in.rows.depths);
  Status status = makeSums(context);
  context.detachMore(1);
  return status;
}

std::vector<gl::Variant> variantsOf(const exact::Variant& variant) {
  if (!variant.glass) return {};
  return {
      {kGroups, exact::definitionsOf(variant)}, {kSums, folding()}, {kSums, summing(false)}, {kSums, summing(true)}};
}

} // namespace tyndall::passes::tint_sums
