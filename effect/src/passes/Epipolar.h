// The epipolar pipeline of one light: the list of its passes (Chen 2011, Yusov 2013).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::epipolar {

/// Adds the light by any technique but Technique::Exact. The frame and light blocks must be bound.
Status run(const PassContext& context, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
           const SliceInputs& inputs);

/// Temporal reuse: the same in two steps, of what inputs.history has planned. Up to the light on slices; `frame` counts
/// the view's, for Reuse::refreshFrames.
Status prepare(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
               const SliceInputs& inputs, int frame);
/// And from there to the destination, of all pixels or of those that the stencil marks.
Status finish(const PassContext& pass, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
              const SliceInputs& inputs);

/// Every shader variant that they can ask for.
std::vector<gl::Variant> allVariants();

} // namespace tyndall::passes::epipolar
