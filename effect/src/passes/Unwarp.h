// Unwarp: from slices to pixels, then the fix-up of those that no sample serves, along the row of their slice (Yusov
// 2013, "Transformation from epipolar to rectangular coordinates"; glsl/passes/unwarp, pixelTree).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::unwarp {

struct In {
  gl::Uint epipolarInscatter = 0;
  rows::Out rows; ///< of the last view: with several, the fix-up walks every texel instead
};

/// Writes to the light's destination; leaves 0 in the stencil of the pixels that were fixed up, 1 in the others'.
Status run(SliceContext& context, const In& in);

} // namespace tyndall::passes::unwarp
