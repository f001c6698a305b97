// March: inscatter at the regular march samples, the first of every sixteen, through one shadow view
// (glsl/passes/march). Views add up.
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::march {

struct In {
  int view = 0;
  rows::Out rows; ///< of that view
  gl::Uint sampleEnds = 0;
};

struct Out {
  gl::Uint marched = 0;
};

Status run(SliceContext& context, const In& in, Out& out);

} // namespace tyndall::passes::march
