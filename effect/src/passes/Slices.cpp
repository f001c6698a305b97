#include "passes/Slices.h"

#include <algorithm>
#include <cmath>

namespace tyndall::passes::slices {

namespace {

// Texels of a row and levels of its tree: the coarsest level keeps at least one node of each row, and four if it can.
// Textures have room for the longest row that the map allows; drawn are as many texels as this frame's longest has.
int chooseRow(const In& in, int longestRow, blocks::EpipolarBlock& block) {
  const int step = in.frame->settings.rowStep;
  const int texels = (std::max({in.map.width, in.map.height, 1}) + step - 1) / step;
  int top = 2;
  while ((texels >> (2 * (top + 1))) >= 4)
    ++top;
  const int unit = 1 << (2 * top);
  const int room = (texels + unit - 1) / unit * unit;
  block.grid.z = std::clamp((longestRow + unit - 1) / unit * unit, unit, room);
  block.grid.w = in.frame->settings.minMaxTree ? top : 0;
  block.march.w = in.light->shadow.texture ? static_cast<int>(in.light->shadow.views.size()) : 0;
  return room;
}

// Shadow views whose rows stand above one another in the row textures: all of a light's, so that rows are made once and
// rays marched once; in equal parts where that would be too much, as for the six large faces of a lamp.
int chooseViewsPerDraw(const PassContext& context, const Out& out) {
  constexpr std::int64_t kMostTexels = std::int64_t{24} << 20; // of all rows; 4 to 10 bytes each, with the tree
  const int views = std::max(out.block.march.w, 1);
  gl::Int mostRows = 0;
  context.gl.GetIntegerv(gl::MAX_TEXTURE_SIZE, &mostRows);
  const std::int64_t most = std::min<std::int64_t>(kMostTexels / out.rowTexels, mostRows) / out.count;
  const int together = static_cast<int>(std::clamp<std::int64_t>(most, 1, views));
  const int draws = (views + together - 1) / together;
  return (views + draws - 1) / draws;
}

} // namespace

Status outOfMemory() { return {StatusCode::OutOfMemory, "GL could not allocate an epipolar texture"}; }

Status run(const PassContext& context, Targets& targets, const In& in, Out& out) {
  const Settings& settings = in.frame->settings;
  out.geometry = optics::makeSlices(*in.frame, *in.light, in.map.width, in.map.height);
  const optics::SliceTable& table = out.geometry;
  out.count = table.slices;
  out.samples = settings.samples;
  out.regularSamples = table.regularSamples;
  out.block = table.block;
  out.block.thresholds = glm::vec4(settings.breakThreshold, settings.leastWeight, settings.bendThreshold,
                                   std::log2(1 + settings.breakThreshold));
  out.block.spread = glm::vec4(settings.spreadThreshold, settings.averageThreshold, 0, 0);
  out.rowTexels = chooseRow(in, table.longestRow, out.block);
  out.viewsPerDraw = chooseViewsPerDraw(context, out);

  return uploadTable(context, targets, Target::SliceTable, table.slices, table.rows, table.texels, out.table);
}

Status uploadTable(const PassContext& context, Targets& targets, Target which, int width, int height,
                   const std::vector<glm::vec4>& texels, gl::Uint& texture) {
  texture = targets.get(which, width, height);
  if (!texture) return outOfMemory();
  const gl::Functions& gl = context.gl;
  gl.ActiveTexture(gl::TEXTURE0 + static_cast<gl::Enum>(gl::Unit::Upload));
  gl.BindTexture(gl::TEXTURE_2D, texture);
  gl.TexSubImage2D(gl::TEXTURE_2D, 0, 0, 0, width, height, gl::RGBA, gl::FLOAT, texels.data());
  return {};
}

} // namespace tyndall::passes::slices
