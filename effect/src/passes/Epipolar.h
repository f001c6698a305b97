// The epipolar pipeline of one light: the list of its passes (Chen 2011, Yusov 2013).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::epipolar {

/// Adds the light by any technique but Technique::Exact. The frame and light blocks must be bound.
Status run(const PassContext& context, Targets& targets, PassRecorder& recorder, const gl::Framebuffer& scratch,
           const SliceInputs& inputs);

/// Every shader variant that run() can ask for.
std::vector<gl::Variant> allVariants();

} // namespace tyndall::passes::epipolar
