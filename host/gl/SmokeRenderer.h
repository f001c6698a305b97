// Smoke: captured from lights, and drawn over the picture.
#pragma once

#include "gl/BufferTexture.h"
#include "gl/QuadRenderer.h"
#include "scene/Smoke.h"

namespace host {

class SmokeRenderer : QuadRenderer {
public:
  explicit SmokeRenderer(std::vector<SmokeParticle> particles);

  /// Other particles from now on.
  void set(std::vector<SmokeParticle> particles);

  /// Draws into the bound framebuffer without attachments, for the Avsm whose lists are bound from binding 0 on.
  void capture(const CaptureView& view);

  /// Blends over the targets, farthest first; writes no depth.
  void draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);

private:
  static constexpr GLuint kParticles = kFirstOwnUnit, kDepth = kFirstOwnUnit + 1;

  void upload(const std::vector<SmokeParticle>& particles);
  void sort(const CameraView& camera);
  glm::ivec2 lightSize() const;
  void lightUp(const CameraView& camera, const Illumination& illumination);
  void copyDepth(const RenderTargets& targets);
  void setView(Program& program, const glm::dmat4& clipFromWorld) const;
  void setDepth(Program& program, const CameraView& camera) const;

  std::vector<SmokeParticle> particles_;
  BufferTexture buffer_;
  GlTexture depth_; ///< the targets' depth, which cannot be read while it is attached
  GlFramebuffer depthFramebuffer_;
  glm::ivec2 depthSize_{0};
  GLenum depthFormat_ = GL_NONE;
};

} // namespace host
