// Rows: the shadow map along every slice, for the views of one draw, and a min/max tree over each (Chen 2011, 3.2
// and 3.3; glsl/passes/rowDepths, rowNodes, rowTree, pairTree).
#pragma once

#include "passes/CurveRows.h"
#include "passes/SliceContext.h"

namespace tyndall::passes::rows {

struct In {
  int draw = 0;
  bool tintSums = false; ///< splits for the walk that uses sums of tints (glass): behind all panes, before all casters
  bool hashes = false;   ///< Out::hashes are wanted, too
};

struct Out {
  gl::Uint depths = 0; ///< 0: the light has no shadow map
  gl::Uint shares = 0; ///< of groups of texels; 0 where a texel is either lit or dark
  gl::Uint hashes = 0; ///< temporal reuse: what tells a change where depths and shares may hide it; else 0
  gl::Uint tree = 0;
  gl::Uint means = 0;
  gl::Uint moments = 0; ///< 0 without glass: beside the means
  curve_rows::Out curves;
};

/// Depths, then the tree, and what dims the light.
Status run(SliceContext& context, const In& in, Out& out);
Status runDepths(SliceContext& context, const In& in, Out& out);
Status runTree(SliceContext& context, const In& in, Out& out);

/// The tree over each two neighbouring rows, in place of out.tree, for rays that run between them.
Status runPairs(SliceContext& context, const In& in, Out& out);

/// The definitions of the walk along rows, and of what is made for it.
gl::Definitions definitionsOf(const exact::Variant& variant, bool tintSums);

/// Copies depths, shares and hashes of the slices that are drawn into `to`, which this makes the light's own.
Status copyDepths(SliceContext& context, const Out& from, Out& to);

/// All programs of a light.
std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

/// For the passes that walk along rows; also binds the maps, which filtered and tinted rows look up.
void bind(const SliceContext& context, const Out& rows);

} // namespace tyndall::passes::rows
