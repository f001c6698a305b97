// What dims light bit by bit: smoke and strands, and their capture from a light.
#pragma once

#include "gl/SmokeRenderer.h"
#include "gl/StrandRenderer.h"

namespace host {

class VolumeRenderer {
public:
  /// See SceneRenderer.
  void set(std::vector<SmokeParticle> smoke, Strands strands, bool drawsSmoke);
  void capture(const tyndall::Light& light, int size);
  void captureSmoke(const tyndall::Light& light, int size);

  void drawStrands(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);
  void drawSmoke(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);

private:
  template <typename Draw>
  void captureViews(const tyndall::Light& light, int size, const Draw& draw);

  std::optional<SmokeRenderer> smoke_; ///< made, and its shaders compiled, when there first is any
  std::optional<StrandRenderer> strands_;
  bool drawsSmoke_ = true;
  GlFramebuffer withoutAttachments_;
};

} // namespace host
