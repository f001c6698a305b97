// Slice view: what a debug view shows of one light's slices, samples and pixels (glsl/passes/viewSlices, viewSamples,
// viewFixup, pixelTree with COUNT_VISITS). passes/View.h brings it into the back buffer.
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::slice_view {

struct In {
  gl::Uint sampleEnds = 0; ///< Technique::Epipolar only, as all that follows
  gl::Uint marks = 0;
  gl::Uint refinedMarks = 0;
};

/// Adds to the view's target; nothing unless the light is the one to show. For FixupPixels the stencil is as unwarp
/// leaves it.
Status run(SliceContext& context, const In& in);

std::vector<gl::Variant> allVariants();

} // namespace tyndall::passes::slice_view
