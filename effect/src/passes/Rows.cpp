#include "passes/Rows.h"

namespace tyndall::passes::rows {

namespace {

gl::Definitions optionsOf(Walk walk) {
  return walk == Walk::TintSums ? gl::Definitions{{"TINT_SUMS", 1}} : gl::Definitions{};
}

} // namespace

void plan(LightPlanner& light, Walk walk) {
  planDepths(light, walk, false);
  planTree(light, walk);
}

void planDepths(LightPlanner& light, Walk walk, bool hashes) {
  if (light.views() == 0) return;
  gl::Definitions options = optionsOf(walk);
  light.extent.hashes = hashes && light.extent.shares;
  if (light.extent.hashes) options.emplace_back("ROW_HASHES", 1);
  light.draw(Pass::RowDepths, {options});
}

void planTree(LightPlanner& light, Walk walk) {
  if (light.views() == 0) return;
  if (light.variant.curves) {
    light.draw(Pass::CurveCells);
    light.draw(Pass::CurveTree);
  }
  if (light.extent.treeLevels == 0) {
    light.skip("tree", "settings.minMaxTree is false");
    for (const Resource unread : {Resource::RowTree, Resource::RowMeans, Resource::RowMoments, Resource::PairTree})
      light.board[unread] = light.board[Resource::RowDepths];
    return;
  }
  light.draw(Pass::RowNodes, {optionsOf(walk)});
  light.draw(Pass::RowTree, {optionsOf(walk)});
}

void planPairs(LightPlanner& light) {
  const Extent& extent = light.extent;
  if (light.views() == 0 || extent.treeLevels == 0) return;
  const int groups = extent.drawnTexels / 4, nodes = rowOf(Resource::RowTree).drawn(extent).width;
  light.draw(Pass::PairGroups, {{}, {}, {}, Viewport{0, 0, groups, extent.rows}});
  light.draw(Pass::PairTree, {{}, {}, {}, Viewport{groups, 0, nodes, extent.rows}});
}

} // namespace tyndall::passes::rows
