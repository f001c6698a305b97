// March extra: inscatter at the marked samples between the regular ones, packed, through one shadow view
// (glsl/passes/strips, marchExtra). Views add up.
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::march_extra {

struct In {
  int view = 0;
  rows::Out rows; ///< of that view
  gl::Uint sampleEnds = 0;
  gl::Uint marks = 0;
  gl::Uint offsets = 0;
};

struct Out {
  gl::Uint extra = 0;
  gl::Uint extraGreen = 0; ///< 0 unless coloured
  gl::Uint extraBlue = 0;
};

Status run(SliceContext& context, const In& in, Out& out);

} // namespace tyndall::passes::march_extra
