// Mean light: the picture's mean inscatter, which tells unwarp what differences matter (glsl/passes/meanLight).
#pragma once

#include "passes/SliceContext.h"

namespace tyndall::passes::mean_light {

struct In {
  gl::Uint marched = 0;
};

struct Out {
  gl::Uint mean = 0;
};

Status run(SliceContext& context, const In& in, Out& out);

/// Every variant that run() can ask for of a light's variant.
std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

} // namespace tyndall::passes::mean_light
