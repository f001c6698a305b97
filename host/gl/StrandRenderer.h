// Strands of hair and the like: captured from lights, and drawn into the picture.
#pragma once

#include "gl/BufferTexture.h"
#include "gl/CameraView.h"
#include "gl/LightTexture.h"
#include "gl/RenderTargets.h"
#include "scene/Strands.h"

#include <optional>

namespace host {

class StrandRenderer {
public:
  explicit StrandRenderer(Strands strands);

  /// Other strands from now on.
  void set(Strands strands);

  /// Draws into the bound framebuffer without attachments, for the Avsm whose lists are bound from binding 0 on.
  void capture(const CaptureView& view);

  /// Blends into the targets, farthest first, and writes depth.
  void draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);

private:
  void uploadPoints();
  void uploadSorted(const CameraView& camera);
  void light(const CameraView& camera, const Illumination& illumination);
  void setView(Program& program, const glm::dmat4& clipFromWorld, const glm::vec4& eye, double pixelSize) const;
  GLsizei count() const { return static_cast<GLsizei>(strands_.segments.size()); }

  Strands strands_;
  glm::dvec3 origin_{0}; ///< of relative positions: the middle of all
  BufferTexture points_;
  BufferTexture segments_;
  LightTexture light_;
  Program strand_;
  std::optional<Program> capture_; ///< needs OpenGL 4.3
  GlVertexArray empty_;
};

} // namespace host
