// Interpolate: inscatter of every sample, between the march samples of its slice (glsl/passes/interpolate).
#pragma once

#include "passes/MarchExtra.h"

namespace tyndall::passes::interpolate {

struct In {
  gl::Uint sampleEnds = 0;
  gl::Uint marks = 0;
  gl::Uint offsets = 0;
  gl::Uint marched = 0;
  march_extra::Out extra;
};

struct Out {
  gl::Uint inscatter = 0; ///< slices x samples
};

Status run(SliceContext& context, const In& in, Out& out);

} // namespace tyndall::passes::interpolate
