// March extra: inscatter at the marked samples between the regular ones, packed, through the shadow
// views of one draw (glsl/passes/strips, marchExtra). Draws add up.
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::march_extra {

struct In {
  int draw = 0;
  rows::Out rows; ///< of that draw
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
