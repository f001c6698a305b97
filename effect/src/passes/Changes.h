// Changes: which slices and pixels are not what they were in the last frame (Frame::reuse; glsl/passes/changedSlices,
// mask, keepDepth, changedStrips).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::changes {

/// What Frame::objects reaches, and what is due to be refreshed, as flags in context.changed; or, if that is too much,
/// the light's Redraw becomes All.
Status findMoved(SliceContext& context, int frame);

struct In {
  gl::Uint sampleEnds = 0, lastSampleEnds = 0; ///< 0, 0: not to be compared
  gl::Uint rows = 0, lastRows = 0;             ///< depths or hashes; likewise
};

/// The same by comparison; the light's `count` will know how many slices.
Status compare(SliceContext& context, const In& in, int frame);

/// Draws the pixels that the bound flags, and the depth, touch. False if the shader does not build.
bool mask(const PassContext& context, const exact::Variant& variant, bool comparesDepth);

/// Draws the scene depth, all of it or where the mask is set.
bool keepDepth(const PassContext& context, bool underMask);

std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

/// What marks a pixel in the stencil: that it is drawn anew, and that unwarp served it.
inline constexpr int kMasked = 0x80, kServed = 0x01;

} // namespace tyndall::passes::changes
