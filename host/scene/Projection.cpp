#include <scene/Projection.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace host {

double ndcNear(const ClipConvention& convention) {
  if (convention.reversed) return 1;
  return convention.clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
}

double ndcFar(const ClipConvention& convention) {
  if (!convention.reversed) return 1;
  return convention.clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
}

// With view depth t = -z, z_ndc = (A z + B) / t = -A + B / t. It is dn at t = n and df at t = f:
//   B / n - A = dn,  B / f - A = df   =>   A = (dn r - df) / (1 - r),  B = n (dn + A),  r = n / f (0 for an infinite
//   f).
glm::dmat4 perspective(double halfWidth, double halfHeight, double nearPlane, double farPlane,
                       const ClipConvention& convention) {
  const double ratio = std::isinf(farPlane) ? 0 : nearPlane / farPlane;
  const double a = (ndcNear(convention) * ratio - ndcFar(convention)) / (1 - ratio);
  glm::dmat4 clipFromView(0);
  clipFromView[0][0] = 1 / halfWidth;
  clipFromView[1][1] = 1 / halfHeight;
  clipFromView[2][2] = a;
  clipFromView[2][3] = -1;
  clipFromView[3][2] = nearPlane * (ndcNear(convention) + a);
  return clipFromView;
}

// z_ndc = A z + B with -A n + B = dn and -A f + B = df.
glm::dmat4 orthographic(double halfWidth, double halfHeight, double nearPlane, double farPlane,
                        const ClipConvention& convention) {
  const double a = (ndcNear(convention) - ndcFar(convention)) / (farPlane - nearPlane);
  glm::dmat4 clipFromView(1);
  clipFromView[0][0] = 1 / halfWidth;
  clipFromView[1][1] = 1 / halfHeight;
  clipFromView[2][2] = a;
  clipFromView[3][2] = ndcNear(convention) + a * nearPlane;
  return clipFromView;
}

glm::dmat4 viewLooking(const glm::dvec3& eye, const glm::dvec3& direction, const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(direction);
  glm::dvec3 right = glm::cross(forward, up);
  // Nearly parallel, the cross product's direction is rounding noise: take the axis that is most across instead.
  if (glm::length(right) < 1e-6 * glm::length(up)) {
    const glm::dvec3 size = glm::abs(forward);
    const glm::dvec3 across = size.z <= size.x && size.z <= size.y ? glm::dvec3(0, 0, 1)
                              : size.x <= size.y                   ? glm::dvec3(1, 0, 0)
                                                                   : glm::dvec3(0, 1, 0);
    right = glm::cross(forward, across);
  }
  right = glm::normalize(right);
  const glm::dmat3 viewFromWorld = glm::transpose(glm::dmat3(right, glm::cross(right, forward), -forward));
  glm::dmat4 result(viewFromWorld);
  result[3] = glm::dvec4(-(viewFromWorld * eye), 1);
  return result;
}

tyndall::Mat4 toMat4(const glm::dmat4& matrix) {
  tyndall::Mat4 result{};
  for (int i = 0; i < 16; ++i)
    result[i] = matrix[i / 4][i % 4];
  return result;
}

glm::dmat4 fromMat4(const tyndall::Mat4& matrix) { return glm::make_mat4(matrix.data()); }

} // namespace host
