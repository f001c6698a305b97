// Unwarp: from slices to pixels, then the fix-up of those that no sample serves, or that an edge of a shadow between
// two slices crosses (Yusov 2013, "Transformation from epipolar to rectangular coordinates"; glsl/passes/unwarp,
// fixup).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::unwarp {

struct In {
  gl::Uint epipolarInscatter = 0;
  gl::Uint meanLight = 0; ///< 0: settings.spreadThreshold is infinite
  rows::Out rows;         ///< of the last draw: with several, the fix-up walks every texel or makes them once more
};

/// Writes to the light's destination; leaves 0 in the stencil of the pixels that were fixed up, 1 in the others'.
Status run(SliceContext& context, const In& in);

/// Every variant that run() can ask for of a light's variant, without those of the pixel tree.
std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

} // namespace tyndall::passes::unwarp
