#include "passes/View.h"

namespace tyndall::passes::view {

namespace {

constexpr const char* kMean = "passes/viewMean.frag";

const char* shaderOf(View view) {
  return view == View::NodeVisits   ? "passes/viewVisits.frag"
         : view == View::Difference ? "passes/viewDifference.frag"
                                    : "passes/viewImage.frag";
}

} // namespace

bool run(const PassContext& context, const In& in) {
  const gl::Functions& gl = context.gl;
  if (in.view == View::Difference) {
    bindTexture(context, gl::Unit::Inscatter, gl::TEXTURE_2D, in.image);
    bindTexture(context, gl::Unit::ViewExact, gl::TEXTURE_2D, in.exact);
    bindTexture(context, gl::Unit::ViewMean, gl::TEXTURE_2D, in.mean);
  } else {
    bindTexture(context, gl::Unit::ViewImage, gl::TEXTURE_2D, in.image);
  }
  setBlend(context, Blend::Replace);
  gl.ColorMaski(0, 1, 1, 1, 0);
  const bool ok = drawFullScreen(context, shaderOf(in.view), {});
  gl.ColorMaski(0, 1, 1, 1, 1);
  return ok;
}

bool runMean(const PassContext& context, const MeanIn& in) {
  const gl::Functions& gl = context.gl;
  setBlend(context, Blend::Replace);
  const auto draw = [&](gl::Uint image, gl::Uint target, int width, int channels) {
    gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, target, 0);
    gl.Viewport(0, 0, width, 1);
    bindTexture(context, gl::Unit::ViewImage, gl::TEXTURE_2D, image);
    return drawFullScreen(context, kMean, {{"CHANNELS", channels}});
  };
  return draw(in.image, in.rowMeans, in.height, in.channels) && draw(in.rowMeans, in.mean, 1, 1);
}

bool prepare(const PassContext& context, View view) {
  const bool hasMean = view == View::Difference || view == View::NodeVisits;
  for (const int channels : {1, 3})
    if (hasMean && !context.programs.use(kMean, {{"CHANNELS", channels}})) return false;
  return context.programs.use(shaderOf(view), {}) != 0;
}

std::vector<gl::Variant> allVariants() {
  return {{shaderOf(View::Inscatter), {}},
          {shaderOf(View::NodeVisits), {}},
          {shaderOf(View::Difference), {}},
          {kMean, {{"CHANNELS", 1}}},
          {kMean, {{"CHANNELS", 3}}}};
}

} // namespace tyndall::passes::view
