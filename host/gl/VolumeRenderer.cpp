#include "gl/VolumeRenderer.h"

#include "gl/RenderState.h"
#include "scene/Error.h"

namespace host {

void VolumeRenderer::set(std::vector<SmokeParticle> smoke, Strands strands, bool drawsSmoke) {
  drawsSmoke_ = drawsSmoke;
  if (smoke_) {
    smoke_->set(std::move(smoke));
  } else if (!smoke.empty()) {
    smoke_.emplace(std::move(smoke));
  }
  if (strands_) {
    strands_->set(std::move(strands));
  } else if (!strands.segments.empty()) {
    strands_.emplace(std::move(strands));
  }
}

template <typename Draw>
void VolumeRenderer::captureViews(const tyndall::Light& light, int size, const Draw& draw) {
  if (!gl().FramebufferParameteri) {
    throw Error("capture of smoke and strands: the context lacks glFramebufferParameteri, which came with OpenGL 4.3");
  }
  if (!withoutAttachments_) {
    withoutAttachments_ = makeFramebuffer();
  }
  resetRenderState();
  applyClipConvention({});
  gl().Disable(GL_DEPTH_TEST);
  gl().BindFramebuffer(GL_FRAMEBUFFER, withoutAttachments_.name());
  gl().FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, size);
  gl().FramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, size);
  gl().Viewport(0, 0, size, size);
  for (int view = 0; view < static_cast<int>(light.shadow.views.size()); ++view) {
    draw(CaptureView(light, view, size));
  }
  resetRenderState();
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void VolumeRenderer::capture(const tyndall::Light& light, int size) {
  if (!smoke_ && !strands_) {
    return;
  }
  captureViews(light, size, [&](const CaptureView& view) {
    if (smoke_) {
      smoke_->capture(view);
    }
    if (strands_) {
      strands_->capture(view);
    }
  });
}

void VolumeRenderer::captureSmoke(const tyndall::Light& light, int size) {
  if (smoke_) {
    captureViews(light, size, [&](const CaptureView& view) { smoke_->capture(view); });
  }
}

void VolumeRenderer::drawStrands(const CameraView& camera, const Illumination& illumination,
                                 const RenderTargets& targets) {
  if (strands_) {
    strands_->draw(camera, illumination, targets);
  }
}

void VolumeRenderer::drawSmoke(const CameraView& camera, const Illumination& illumination,
                               const RenderTargets& targets) {
  if (smoke_ && drawsSmoke_) {
    smoke_->draw(camera, illumination, targets);
  }
}

} // namespace host
