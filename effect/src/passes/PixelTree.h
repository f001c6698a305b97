// Pixel tree: every pixel through its slice's tree, in as few draws as its rows allow (Chen 2011;
// glsl/passes/pixelTree).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::pixel_tree {

struct In {
  bool countVisits = false; ///< add what the walks look at to the debug view, instead of light to the destination
};

Status run(SliceContext& context, const In& in);

/// Every variant that run() can ask for of a light's variant.
std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

} // namespace tyndall::passes::pixel_tree
