// Curve rows: smoke and hair (Light::curves) along the rows of a draw, cell by cell, and a tree over the cells
// (glsl/passes/curveCells, curveTree, lib/curves).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::curve_rows {

struct Out {
  gl::Uint cells = 0, tree = 0; ///< 0: nothing dims the light
};

/// The draw must be selected.
Status run(SliceContext& context, Out& out);

std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

/// For the passes that walk along rows.
void bind(const SliceContext& context, const Out& curves);

} // namespace tyndall::passes::curve_rows
