// The rays of a camera through its pixel centres, and distances along them, in double precision.
#pragma once

#include "Ray.h"

#include <tyndall/tyndall.h>

namespace reference {

glm::dmat4 toMat4(const tyndall::Mat4& m);

/// Window depth in [0, 1] to clip z over clip w.
double ndcFromDepth(tyndall::ClipDepth clipDepth, double depth);

class CameraRays {
public:
  CameraRays(const tyndall::Camera& camera, int width, int height);

  /// Depth decreases with distance: 0 is the far value, otherwise 1 is.
  bool reversed() const { return reversed_; }

  /// From the eye (perspective) or from the near plane (orthographic) through the centre of a pixel; row 0 is the
  /// bottom row.
  Ray ray(int x, int y) const;

  /// How far along ray(x, y) a window depth lies; infinite for the far value, NaN for NaN.
  double distance(int x, int y, double depth) const;

  /// The part of ray(x, y) between the near and the far plane; an infinite far plane is infinitely far.
  Interval nearToFar(int x, int y) const;

private:
  glm::dvec3 worldPoint(double ndcX, double ndcY, double ndcZ) const;
  glm::dvec2 ndc(int x, int y) const;

  glm::dmat4 viewFromClip_;
  glm::dmat4 worldFromView_;
  tyndall::ClipDepth clipDepth_;
  int width_;
  int height_;
  bool perspective_;
  bool reversed_;
  glm::dvec3 eye_{0};
};

} // namespace reference
