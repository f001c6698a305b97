// Changes: which slices, segments and pixels are not what they were in the last frame (Frame::reuse;
// glsl/passes/changedSlices, mask, keepDepth, changedStrips).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::changes {

/// The slices that Frame::objects reaches, and those due to be refreshed: only they are to be compared, and until then
/// drawn.
Status findMoved(SliceContext& context, int frame);

struct In {
  gl::Uint sampleEnds = 0, lastSampleEnds = 0; ///< the last ones 0: not to be compared
  rows::Out rows, lastRows;                    ///< likewise
};

/// Compares, and has only slices and segments drawn from then on that differ or are due; the light's `count` will know
/// how many segments.
Status compare(SliceContext& context, const In& in, int frame);

/// Draws the pixels that the bound flags, and the depth, touch. False if the shader does not build.
bool mask(const PassContext& context, const exact::Variant& variant, bool comparesDepth);

/// Draws the scene depth, all of it or where the mask is set.
bool keepDepth(const PassContext& context, bool underMask);

std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

/// What marks a pixel in the stencil: that it is drawn anew, and that unwarp served it.
inline constexpr int kMasked = 0x80, kServed = 0x01;

} // namespace tyndall::passes::changes
