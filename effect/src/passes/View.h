// View: the picture of a debug view, over the back buffer's RGB (glsl/passes/viewImage, viewVisits, viewDifference,
// viewMean).
#pragma once

#include "passes/PassContext.h"

#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::passes::view {

struct In {
  View view = View::Inscatter;
  gl::Uint image = 0; ///< what to show; of a difference the technique's inscatter
  gl::Uint exact = 0; ///< of a difference: exact's inscatter, and the 1 x 1 texture of its mean
  gl::Uint mean = 0;
};

/// The bound framebuffer's first target is the back buffer; its alpha stays. False if the shader does not build.
bool run(const PassContext& context, const In& in);

struct MeanIn {
  gl::Uint image = 0;
  int channels = 3;      ///< that count: R, G and B, or 1: R alone
  int height = 0;        ///< of the image
  gl::Uint rowMeans = 0; ///< receives the means of its rows, height x 1
  gl::Uint mean = 0;     ///< receives their mean, 1 x 1
};

/// Draws into the bound framebuffer with targets of its own. False if the shader does not build.
bool runMean(const PassContext& context, const MeanIn& in);

/// Compiles what a view's picture needs, before anything is drawn. False if a shader does not build.
bool prepare(const PassContext& context, View view);

std::vector<gl::Variant> allVariants();

} // namespace tyndall::passes::view
