// Rows: the shadow map along every slice, for the views of the selected draw, and a min/max tree over each (Chen
// 2011, 3.2 and 3.3; glsl/passes/rowDepths, rowNodes, rowTree, pairTree), and what dims the light there (curveCells,
// curveTree).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::rows {

/// What splits of a row are for.
enum class Walk {
  Lit,      ///< spans of light
  TintSums, ///< sums of tints (glass): behind all panes, before all casters
};

/// Depths, then the tree, and what dims the light.
void plan(LightPlanner& light, Walk walk = Walk::Lit);
/// The two steps apart. `hashes`: what tells a change where depths and shares may hide it (temporal reuse).
void planDepths(LightPlanner& light, Walk walk, bool hashes);
void planTree(LightPlanner& light, Walk walk);

/// The tree over each two neighbouring rows, for rays that run between them.
void planPairs(LightPlanner& light);

} // namespace tyndall::passes::rows
