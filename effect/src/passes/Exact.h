// Exact: inscatter of one light by every shadow texel along every pixel's ray (glsl/passes/exact.frag).
#pragma once

#include "passes/PassContext.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::passes::exact {

/// What selects a shader variant.
struct Variant {
  int lightKind = 3;   ///< 0 directional, 1 point, 2 spot, 3 no light: transmittance only
  int shadowViews = 0; ///< 0, 1, or 2 for several
  bool shadowArray = false;
  bool bilinear = false;
  bool glass = false;
  bool curves = false; ///< smoke and hair dim the light (Light::curves); never with `composite`
  bool monochrome = false;
  bool multisampled = false;
  bool composite = false; ///< dual-source outputs instead of two targets
};

gl::Definitions definitionsOf(const Variant& variant);

/// Every variant that a frame can ask for.
std::vector<Variant> allVariants();

struct In {
  Variant variant;
  gl::Uint sceneDepth = 0;
  const Light* light = nullptr; ///< null: transmittance only
  Blend blend = Blend::Replace; ///< the bound framebuffer receives it
};

/// The blocks must be bound. False if the shader does not build.
bool run(const PassContext& context, const In& in);

} // namespace tyndall::passes::exact
