#include "optics/Projections.h"

#include <cmath>

namespace tyndall::optics {

Projection::Projection(const glm::dmat4& clipFromWorld, ClipDepth clipDepth)
    : depthClipFromWorld(depthFromClip(clipDepth) * clipFromWorld),
      worldFromDepthClip(glm::inverse(depthClipFromWorld)) {}

double Projection::farOverNear(bool reversed) const {
  constexpr double kRounding = 1e-6;                                                // of a matrix of floats
  const double near = middle(reversed ? 1 : 0).w, far = middle(reversed ? 0 : 1).w; // 1 over their distances
  return std::abs(far) <= kRounding * std::abs(near) ? kInfinity : near / far;
}

bool hasUsualRow(const glm::dmat4& m) {
  constexpr double kRounding = 1e-5;
  const bool perspective = std::abs(std::abs(m[2][3]) - 1) < kRounding && std::abs(m[3][3]) < kRounding;
  const bool parallel = std::abs(m[2][3]) < kRounding && std::abs(m[3][3] - 1) < kRounding;
  return std::abs(m[0][3]) + std::abs(m[1][3]) < kRounding && (perspective || parallel);
}

} // namespace tyndall::optics
