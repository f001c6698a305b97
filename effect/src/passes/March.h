// March: inscatter at the regular march samples, the first of every sixteen, through the shadow
// views of one draw (glsl/passes/march). Draws add up.
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::march {

struct In {
  int draw = 0;
  rows::Out rows; ///< of that draw
  gl::Uint sampleEnds = 0;
};

struct Out {
  gl::Uint marched = 0;
};

Status run(SliceContext& context, const In& in, Out& out);

} // namespace tyndall::passes::march
