#include "passes/Composite.h"

namespace tyndall::passes::composite {

bool run(const PassContext& context, const In& in) {
  bindTexture(context, gl::Unit::Inscatter, gl::TEXTURE_2D, in.inscatter);
  bindTexture(context, gl::Unit::Transmittance, gl::TEXTURE_2D, in.transmittance);
  setBlend(context, Blend::DualSource);
  return drawFullScreen(context, "passes/composite.frag", {});
}

} // namespace tyndall::passes::composite
