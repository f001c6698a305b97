// Composite: blends finished inscatter and transmittance into the back buffer (glsl/passes/composite.frag).
#pragma once

#include "passes/PassContext.h"

namespace tyndall::passes::composite {

struct In {
  gl::Uint inscatter = 0;
  gl::Uint transmittance = 0;
};

/// The bound framebuffer's first target is the back buffer. False if the shader does not build.
bool run(const PassContext& context, const In& in);

} // namespace tyndall::passes::composite
