// What a renderer needs of a camera or of a light's view, taken apart once.
#pragma once

#include "gl/ClipConvention.h"

namespace host {

struct CameraView {
  explicit CameraView(const tyndall::Camera& camera);

  glm::dmat4 clipFromView;
  glm::dmat4 viewFromWorld;
  glm::dmat4 clipFromWorld;
  glm::dmat4 worldFromView;
  glm::dvec3 eye; ///< the camera's position
  bool perspective;
  ClipConvention convention;

  /// (xyz - w * position) points to the viewer, for positions relative to `origin`.
  glm::vec4 viewerFrom(const glm::dvec3& origin) const;
};

/// One of a light's shadow views, while its blockers are captured.
struct CaptureView {
  /// Throws host::Error if the view's depth has no end.
  CaptureView(const tyndall::Light& light, int view, int size);

  glm::dmat4 clipFromWorld;
  glm::dvec4 depthPlane; ///< tyndall::avsmDepth()
  glm::dvec4 light;      ///< its position, w = 1, or the direction to it, w = 0
  int layer;
  int size; ///< texels per side
};

glm::dmat4 translation(const glm::dvec3& by);

} // namespace host
