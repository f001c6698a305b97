// Rules that fields of several kinds have in common, and the parts of checkValues() that are about lights and ranges.
#pragma once

#include "FieldText.h"
#include "optics/Matrices.h"

#include <cmath>
#include <string>
#include <tyndall/tyndall.h>

namespace tyndall {

template <typename Vector>
bool isFinite(const Vector& v) {
  for (const auto x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

template <typename Vector>
bool isNonNegative(const Vector& v) {
  for (const auto x : v)
    if (!(std::isfinite(x) && x >= 0)) return false;
  return true;
}

inline bool isZero(const Vec3& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

inline Status checkMatrix(const std::string& field, const Mat4& matrix) {
  if (!isFinite(matrix)) return invalid(field, "not finite", "every element must be a finite number");
  if (!optics::isInvertible(optics::toGlm(matrix))) return invalid(field, "singular", "the matrix must be invertible");
  return {};
}

inline Status checkClipDepth(const std::string& field, ClipDepth clipDepth) {
  if (clipDepth == ClipDepth::NegativeOneToOne || clipDepth == ClipDepth::ZeroToOne) return {};
  return invalid(field, std::to_string(static_cast<int>(clipDepth)), "must be one of the enumerators");
}

inline Status checkNodes(const std::string& field, const AvsmCurves& curves) {
  if (curves.nodes >= 4 && curves.nodes <= 16 && curves.nodes % 4 == 0) return {};
  return invalid(field, std::to_string(curves.nodes), "must be 4, 8, 12 or 16");
}

Status checkViewport(const Rectangle& viewport);
Status checkCamera(const Camera& camera);

/// The planes that curves before the eye lie between (Frame::eyeCurves, eyeLight()); the camera has passed its check.
Status checkEyePlanes(const Camera& camera, double nearDistance, double farDistance);

/// Numbers of a light and of its shadow views; `field` is "lights[i].".
Status checkLight(const std::string& field, const Light& light);

/// Of what passes all else: whether 32-bit floats hold what shaders are given of it.
Status checkRange(const Frame& frame);

} // namespace tyndall
