// Refine: more march samples where the inscatter itself bends, and where each chunk's extra samples go
// (glsl/passes/refine, offsets).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::refine {

struct In {
  gl::Uint marks = 0;
  gl::Uint marched = 0;
};

struct Out {
  gl::Uint marks = 0;
  gl::Uint offsets = 0;
};

Status run(SliceContext& context, const In& in, Out& out);

} // namespace tyndall::passes::refine
