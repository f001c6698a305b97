#include "plan/LightPlanner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

LightPlanner::LightPlanner(const PassPlanner& planner, const Frame& lit, const DrawnLight& drawn,
                           const FrameTextures& textures, const Limits& limits)
    : PassPlanner(planner), frame(lit), light(frame.lights[drawn.index]), limits_(limits) {
  const FrameTextures::Shadow& map = textures.shadows[drawn.index];
  name = drawn.name;
  variant = drawn.variant;
  lightBlock = plan.add(drawn.block);
  extent.coloured = variant.isColoured();
  extent.glass = variant.glass;
  extent.shares = variant.hasShares();
  extent.curveCells = map.curvesSize;
  extent.terms = frame.settings.lowRankTerms;
  board[Resource::ShadowMap] = light.shadow.texture;
  board[Resource::GlassColour] = light.glass.colour;
  board[Resource::GlassDepth] = light.glass.depth;
  board[Resource::Curves] = light.curves.texture;
  copies_ = drawn.copies;
  layerSize_ = {map.width, map.height};
  if (variant.shadowViews > 0) shadowViews_ = static_cast<int>(light.shadow.views.size());
  for (int i = 0; i < shadowViews_; ++i)
    mapSize_ = {std::max(mapSize_.width, drawn.block.shadowViews[i].size.x),
                std::max(mapSize_.height, drawn.block.shadowViews[i].size.y)};
  paths.views = shadowViews_;
  paths.map = mapSize_;
  if (copies_.empty()) return;
  source_ = map.copySource;
  extent.mapCopy = {mapSize_.width, mapSize_.height, shadowViews_};
  extent.floatTint = map.floatTint;
}

void LightPlanner::copyMaps(const Board* last) {
  if (copies_.empty()) return;
  if (last && textureOf(Resource::ShadowCopy) == (*last)[Resource::ShadowCopy]) return takeCopies(*last);
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    epipolarBlock = plan.add(copies_[i]);
    const glm::ivec2 size = copies_[i].copiedSize;
    DrawOptions options{{{"SOURCE", source_}, {"GLASS", variant.glass ? 1 : 0}}};
    options.viewport = Viewport{0, 0, size.x, size.y};
    options.layer = static_cast<int>(i);
    draw(Pass::MapCopy, options);
  }
  readCopies();
}

void LightPlanner::takeCopies(const Board& last) {
  if (copies_.empty()) return;
  skip("map copy", "the maps have not changed");
  for (const Resource resource : {Resource::ShadowCopy, Resource::GlassColourCopy, Resource::GlassDepthCopy}) {
    board[resource] = last[resource];
    if (board[resource] != 0) textureOf(resource); // which is needed in this frame
  }
  readCopies();
}

void LightPlanner::readCopies() {
  board[Resource::ShadowMap] = board[Resource::ShadowCopy];
  board[Resource::GlassColour] = board[Resource::GlassColourCopy];
  board[Resource::GlassDepth] = board[Resource::GlassDepthCopy];
}

void LightPlanner::makeSlices(optics::SliceSampling sampling) {
  sampling.widest = limits_.textureSize;
  const Settings& settings = frame.settings;
  geometry = optics::makeSlices(frame, light, layerSize_.width, layerSize_.height, sampling);
  regularSamples = geometry.regularSamples;
  block = geometry.block;
  block.breakThreshold = settings.breakThreshold;
  block.endThreshold = std::log2(1 + settings.breakThreshold);
  block.bendThreshold = settings.bendThreshold;
  block.leastWeight = settings.leastWeight;
  block.spreadThreshold = settings.spreadThreshold;
  block.averageThreshold = settings.averageThreshold;
  extent.slices = geometry.drawn;
  extent.candidateSlices = geometry.slices;
  extent.tableRows = geometry.rows;
  extent.samples = sampling.samples;
  chooseRow(geometry.longestRow, sampling.rowStep);
  viewsPerDraw = chooseViewsPerDraw();
  extent.rowRoom = extent.slices * viewsPerDraw;
  extent.floatRows = block.rowCodeSteps == 0;
  upload(block.sliceTarget > 0 ? Resource::CandidateTable : Resource::SliceTable, geometry.texels);
}

// Texels of a row and levels of its tree: the coarsest level keeps at least one node of each row, and four if it can.
// Textures have room for the longest row that the map allows; drawn are as many texels as this frame's longest has.
void LightPlanner::chooseRow(int longestRow, int rowStep) {
  const int texels = unitsFor(std::max({mapSize_.width, mapSize_.height, 1}), rowStep);
  int top = 2;
  while ((texels >> (2 * (top + 1))) >= 4)
    ++top;
  const int unit = 1 << (2 * top);
  extent.rowTexels = roundedUp(texels, unit);
  extent.drawnTexels = std::clamp(roundedUp(longestRow, unit), unit, extent.rowTexels);
  extent.treeLevels = frame.settings.minMaxTree ? top : 0;
  block.rowLength = extent.drawnTexels;
  block.treeLevels = extent.treeLevels;
  paths.rowTexels = extent.drawnTexels;
  paths.tree = frame.settings.minMaxTree;
}

// Shadow views whose rows stand above one another in the row textures: all of a light's, so that rows are made once and
// rays marched once; in equal parts where that would be too much, as for the six large faces of a lamp.
int LightPlanner::chooseViewsPerDraw() const {
  constexpr std::int64_t kMostTexels = std::int64_t{24} << 20; // of all rows; 4 to 10 bytes each, with the tree
  const int all = std::max(views(), 1);
  const std::int64_t most = std::min<std::int64_t>(kMostTexels / extent.rowTexels, limits_.textureSize) / extent.slices;
  const int together = static_cast<int>(std::clamp<std::int64_t>(most, 1, all));
  const int parts = unitsFor(all, together);
  return unitsFor(all, parts);
}

void LightPlanner::selectDraw(int draw) {
  block.firstView = draw * viewsPerDraw;
  block.drawnViews = std::min(viewsPerDraw, views() - block.firstView);
  block.bringsOutside = draw == 0 ? 1 : 0;
  extent.rows = extent.slices * block.drawnViews;
  paths.drawnViews = block.drawnViews;
  drawIndex = draw;
  epipolarBlock = plan.add(block);
}

void LightPlanner::upload(Resource resource, std::vector<glm::vec4> texels) {
  const Size size = rowOf(resource).size(extent);
  board[resource] = textureOf(resource);
  plan.steps.emplace_back(Upload{board[resource], size.width, size.height, std::move(texels)});
}

// What the next frame needs is the light's own. Rows that do not stand in one texture are made anew.
Targets& LightPlanner::holderOf(Lifetime lifetime) {
  if (!keptTargets) return PassPlanner::holderOf(lifetime);
  switch (lifetime) {
  case Lifetime::Light:
  case Lifetime::Compared:
    return *keptTargets;
  case Lifetime::LightRows:
  case Lifetime::ComparedRows:
    return draws() == 1 ? *keptTargets : frameTargets;
  default:
    return PassPlanner::holderOf(lifetime);
  }
}

int LightPlanner::sideOf(Lifetime lifetime) const {
  return lifetime == Lifetime::Compared ? endsSide : lifetime == Lifetime::ComparedRows ? rowsSide : 0;
}

} // namespace tyndall
