// What a matrix of a projection says of itself: where its rays come from, its planes, whether it mirrors.
#pragma once

#include "optics/Matrices.h"

namespace tyndall::optics {

/// Of a clipFromWorld, or a clipFromView.
struct Projection {
  Projection() = default;
  Projection(const glm::dmat4& clipFromWorld, ClipDepth clipDepth);

  glm::dmat4 depthClipFromWorld{1}; ///< clip z is depth times w
  glm::dmat4 worldFromDepthClip{1};

  /// Where all its rays meet: a point (w not 0), or, if they are parallel, their direction.
  glm::dvec4 centre() const { return worldFromDepthClip[2]; }
  glm::dvec3 eye() const { return glm::dvec3(centre()) / centre().w; }

  /// The point at depth `depth` of its middle ray, homogeneous.
  glm::dvec4 middle(double depth) const { return worldFromDepthClip * glm::dvec4(0, 0, depth, 1); }

  /// Row w without its constant: along the axis of a perspective view.
  glm::dvec3 forward() const { return glm::dvec3(glm::transpose(depthClipFromWorld)[3]); }

  /// Whether right, up and away in the picture are mirrored in the world, if depth grows away, or falls if reversed.
  bool isMirrored(bool reversed) const { return (glm::determinant(depthClipFromWorld) < 0) == reversed; }

  /// Far plane's distance over the near plane's, of a perspective; infinite within float's rounding, negative if the
  /// far plane lies behind the eye.
  double farOverNear(bool reversed) const;
};

/// True if row w is that of a perspective (0, 0, +-1, 0) or of an orthographic projection (0, 0, 0, 1).
bool hasUsualRow(const glm::dmat4& clipFromView);

} // namespace tyndall::optics
