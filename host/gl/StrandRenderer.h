// Strands of hair and the like: captured from lights, and drawn into the picture.
#pragma once

#include "gl/BufferTexture.h"
#include "gl/QuadRenderer.h"
#include "scene/Strands.h"

namespace host {

class StrandRenderer : QuadRenderer {
public:
  explicit StrandRenderer(Strands strands);

  /// Other strands from now on.
  void set(Strands strands);

  /// Draws into the bound framebuffer without attachments, for the Avsm whose lists are bound from binding 0 on.
  void capture(const CaptureView& view);

  /// Blends into the targets, farthest first, and writes depth.
  void draw(const CameraView& camera, const Illumination& illumination, const RenderTargets& targets);

private:
  static constexpr GLuint kPoints = kFirstOwnUnit, kSegments = kFirstOwnUnit + 1;

  void uploadPoints();
  void uploadSorted(const CameraView& camera);
  void lightUp(const CameraView& camera, const Illumination& illumination);
  void setSegments(Program& program, double pixelSize) const;

  Strands strands_;
  BufferTexture points_;
  BufferTexture segments_;
};

} // namespace host
