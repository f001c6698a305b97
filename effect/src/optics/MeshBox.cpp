#include "optics/MeshBox.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace tyndall::optics {

namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;

// The box along the given axes, which are orthonormal.
dmat4 boxAlong(const std::vector<glm::vec3>& points, const dmat3& axes) {
  dvec3 low(std::numeric_limits<double>::max()), high = -low;
  const dmat3 toAxes = glm::transpose(axes);
  for (const glm::vec3& point : points) {
    const dvec3 p = toAxes * dvec3(point);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const dvec3 middle = 0.5 * (low + high);
  dvec3 half = 0.5 * (high - low);
  // Rounding of the axes, too, must leave every point inside.
  const double size = std::max({half.x, half.y, half.z, 1e-6 * glm::length(middle), 1e-30});
  half = glm::max(half * (1 + 1e-9), dvec3(1e-4 * size));
  return {glm::dvec4(axes[0] * half.x, 0), glm::dvec4(axes[1] * half.y, 0), glm::dvec4(axes[2] * half.z, 0),
          glm::dvec4(axes * middle, 1)};
}

double volumeOf(const dmat4& box) { return std::abs(glm::determinant(dmat3(box))); }

dmat3 principalAxes(const std::vector<glm::vec3>& points) {
  dvec3 mean(0);
  for (const glm::vec3& point : points)
    mean += dvec3(point) / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const glm::vec3& point : points) {
    const dvec3 d = dvec3(point) - mean;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    spread += v * v.transpose();
  }
  const Eigen::Matrix3d e = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  return {dvec3(e(0, 0), e(1, 0), e(2, 0)), dvec3(e(0, 1), e(1, 1), e(2, 1)), dvec3(e(0, 2), e(1, 2), e(2, 2))};
}

} // namespace

dmat4 boxAround(const std::vector<glm::vec3>& points) {
  const dmat4 upright = boxAlong(points, dmat3(1)), turned = boxAlong(points, principalAxes(points));
  return volumeOf(turned) < volumeOf(upright) ? turned : upright;
}

} // namespace tyndall::optics
