// Smoke: captured from lights, and drawn over the picture.
#pragma once

#include "gl/BufferTexture.h"
#include "gl/CameraView.h"
#include "gl/LightTexture.h"
#include "gl/RenderTargets.h"
#include "scene/Smoke.h"

#include <optional>

namespace host {

class SmokeRenderer {
public:
  explicit SmokeRenderer(std::vector<SmokeParticle> particles);

  /// Other particles from now on.
  void set(std::vector<SmokeParticle> particles);

  /// Draws into the bound framebuffer without attachments, for the Avsm whose lists are bound from binding 0 on.
  void capture(const CaptureView& view);

  /// Blends over the targets, farthest first; writes no depth.
  void draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);

private:
  void upload(const std::vector<SmokeParticle>& particles);
  void sort(const CameraView& camera);
  void light(const CameraView& camera, const Illumination& illumination);
  void copyDepth(const RenderTargets& targets);
  void setView(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye) const;
  void setDepth(const CameraView& camera);
  GLsizei count() const { return static_cast<GLsizei>(particles_.size()); }

  std::vector<SmokeParticle> particles_;
  glm::dvec3 origin_{0}; ///< of relative positions: the middle of all
  BufferTexture buffer_;
  LightTexture light_;
  Program smoke_;
  std::optional<Program> capture_; ///< needs OpenGL 4.3
  GlTexture depth_;                ///< the targets' depth, which cannot be read while it is attached
  GlFramebuffer depthFramebuffer_;
  glm::ivec2 depthSize_{0};
  GLenum depthFormat_ = GL_NONE;
  GlVertexArray empty_;
};

} // namespace host
