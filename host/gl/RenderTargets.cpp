#include "gl/RenderTargets.h"

#include "scene/Error.h"

#include <algorithm>
#include <tyndall/tyndall.h>

namespace host {

float RenderTargets::maxRadiance() const {
  const bool isFloat = options_.colourFormat == GL_RGBA32F || options_.colourFormat == GL_RGB32F;
  return isFloat ? 1e30F : 6e4F; // half floats end at 65504
}

int mostSamples() {
  GLint colour = 1, depth = 1;
  gl().GetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colour);
  gl().GetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depth);
  return std::min(colour, depth);
}

RenderTargets::RenderTargets(const RenderTargetOptions& options) : options_(options) {
  const int width = options.width;
  const int height = options.height;
  if (width < 1 || height < 1 || width > tyndall::kMaxImageSize || height > tyndall::kMaxImageSize) {
    throw Error("render target " + std::to_string(width) + "x" + std::to_string(height) + ": each side must be 1 to " +
                std::to_string(tyndall::kMaxImageSize) + " pixels");
  }
  if (multisampled() && options.samples > mostSamples())
    throw Error("msaa: " + std::to_string(options.samples) + " samples of a pixel: this context has at most " +
                std::to_string(mostSamples()));
  colour_ = makeTexture2D(options.colourFormat, width, height);
  if (multisampled()) {
    multisampledColour_ = makeTexture2DMultisample(options.colourFormat, width, height, options.samples);
    depth_ = makeTexture2DMultisample(options.depthFormat, width, height, options.samples);
    resolved_ = makeFramebuffer();
    gl().BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    requireCompleteFramebuffer("resolved render target");
  } else {
    depth_ = makeTexture2D(options.depthFormat, width, height);
  }
  const GLenum target = multisampled() ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  const GlTexture& drawnColour = multisampled() ? multisampledColour_ : colour_;
  framebuffer_ = makeFramebuffer();
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target, drawnColour.name(), 0);
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, depthAttachmentOf(options.depthFormat), target, depth_.name(), 0);
  requireCompleteFramebuffer("render target");
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RenderTargets::resolve() {
  if (!multisampled()) {
    return;
  }
  gl().Disable(GL_SCISSOR_TEST);
  gl().BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  gl().BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
  gl().BlitFramebuffer(0, 0, width(), height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace host
