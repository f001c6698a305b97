// Matrices in double between the public header and GLM, and what a projection tells about itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace tyndall::optics {

inline glm::dmat4 toGlm(const Mat4& m) {
  glm::dmat4 result;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      result[c][r] = m[static_cast<std::size_t>(4 * c + r)];
  return result;
}

inline glm::dvec3 toGlm(const Vec3& v) { return {v[0], v[1], v[2]}; }
inline glm::vec3 toGlm(const Rgb& v) { return {v[0], v[1], v[2]}; }

/// The direction of a vector of any length but 0, also of one whose square is no double.
inline glm::dvec3 directionOf(const glm::dvec3& v) {
  return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
}

/// windowFromClip for depth: clip z in [-1, 1] or [0, 1] to [0, 1]; x and y stay.
glm::dmat4 depthFromClip(ClipDepth clipDepth);

/// True if the matrix can be inverted in double: its determinant after rows and columns are scaled to size 1 is not 0.
bool isInvertible(const glm::dmat4& m);

/// True if no entry of the last row's x, y, z is set: parallel projection.
bool isOrthographic(const glm::dmat4& clipFromWorld);

/// The eye of a perspective projection; for an orthographic one the centre of its clip volume.
glm::dvec3 eyeOf(const glm::dmat4& depthClipFromWorld);

/// True if depth (clip z / w, mapped to [0, 1]) decreases along the direction at the centre of the clip volume.
bool isReversed(const glm::dmat4& depthClipFromWorld, const glm::dvec3& direction);

/// The same of a light's shadow view, away from the light.
bool isReversedView(const Light& light, int view);

/// Depth that is linear along a shadow view, 0 at its near and 1 at its far plane: dot(coefficients.xyz, p) + w.
struct DepthPlane {
  glm::dvec4 coefficients{0};
  bool exists = false; ///< false with a far plane at infinity
};
DepthPlane linearDepth(const Light& light, int view);

} // namespace tyndall::optics
