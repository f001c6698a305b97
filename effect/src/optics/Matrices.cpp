#include "optics/Matrices.h"

#include <cmath>

namespace tyndall::optics {

glm::dmat4 depthFromClip(ClipDepth clipDepth) {
  glm::dmat4 m(1);
  if (clipDepth == ClipDepth::NegativeOneToOne) {
    m[2][2] = 0.5;
    m[3][2] = 0.5;
  }
  return m;
}

bool isInvertible(const glm::dmat4& matrix) {
  glm::dmat4 m = matrix;
  for (int pass = 0; pass < 4; ++pass) {
    for (int c = 0; c < 4; ++c) {
      const double size =
          std::max(std::max(std::abs(m[c][0]), std::abs(m[c][1])), std::max(std::abs(m[c][2]), std::abs(m[c][3])));
      if (!(size > 0) || !std::isfinite(size)) return false;
      m[c] /= size;
    }
    m = glm::transpose(m); // columns and rows in turn
  }
  return std::abs(glm::determinant(m)) > 1e-13; // double's rounding of a matrix of entries of size 1
}

bool isOrthographic(const glm::dmat4& clipFromWorld) {
  return clipFromWorld[0][3] == 0 && clipFromWorld[1][3] == 0 && clipFromWorld[2][3] == 0;
}

glm::dvec3 eyeOf(const glm::dmat4& depthClipFromWorld) {
  const glm::dmat4 worldFromClip = glm::inverse(depthClipFromWorld);
  if (!isOrthographic(depthClipFromWorld)) {
    const glm::dvec4 eye = worldFromClip[2]; // the point with clip x = y = w = 0
    return glm::dvec3(eye) / eye.w;
  }
  const glm::dvec4 centre = worldFromClip * glm::dvec4(0, 0, 0.5, 1);
  return glm::dvec3(centre) / centre.w;
}

bool isReversed(const glm::dmat4& depthClipFromWorld, const glm::dvec3& direction) {
  const glm::dmat4 worldFromClip = glm::inverse(depthClipFromWorld);
  const glm::dvec4 centre = worldFromClip * glm::dvec4(0, 0, 0.5, 1);
  const glm::dvec4 clip = depthClipFromWorld * glm::dvec4(glm::dvec3(centre) / centre.w, 1);
  const glm::dvec4 slope = depthClipFromWorld * glm::dvec4(direction, 0);
  return slope.z * clip.w - clip.z * slope.w < 0; // the sign of d(z / w)
}

bool isReversedView(const Light& light, int view) {
  const glm::dmat4 depthClipFromWorld =
      depthFromClip(light.shadow.clipDepth) * toGlm(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld);
  const glm::dvec4 centre = glm::inverse(depthClipFromWorld) * glm::dvec4(0, 0, 0.5, 1);
  const glm::dvec3 travel = light.kind == LightKind::Directional
                                ? toGlm(light.direction)
                                : glm::dvec3(centre) / centre.w - toGlm(light.position);
  return isReversed(depthClipFromWorld, travel);
}

DepthPlane linearDepth(const Light& light, int view) {
  const glm::dmat4 depthClipFromWorld =
      depthFromClip(light.shadow.clipDepth) * toGlm(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld);
  const glm::dmat4 worldFromClip = glm::inverse(depthClipFromWorld);
  const bool reversed = isReversedView(light, view);
  const glm::dvec4 near = worldFromClip * glm::dvec4(0, 0, reversed ? 1 : 0, 1);
  const glm::dvec4 far = worldFromClip * glm::dvec4(0, 0, reversed ? 0 : 1, 1);
  // A perspective far plane is as many times farther as its homogeneous weight is smaller: no more than what floats
  // tell apart.
  if (std::abs(far.w) <= 1e-9 * std::abs(near.w)) return {};
  const glm::dmat4 rows = glm::transpose(depthClipFromWorld);
  const glm::dvec3 along(rows[isOrthographic(depthClipFromWorld) ? 2 : 3]);
  const glm::dvec3 from = glm::dvec3(near) / near.w;
  const glm::dvec3 slope = along / glm::dot(along, glm::dvec3(far) / far.w - from);
  return {glm::dvec4(slope, -glm::dot(slope, from)), true};
}

} // namespace tyndall::optics
