#include "CameraRays.h"

#include <cmath>

namespace reference {

glm::dmat4 toMat4(const tyndall::Mat4& m) {
  glm::dmat4 result;
  for (std::size_t i = 0; i < m.size(); ++i)
    result[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = m[i];
  return result;
}

double ndcFromDepth(tyndall::ClipDepth clipDepth, double depth) {
  return clipDepth == tyndall::ClipDepth::ZeroToOne ? depth : 2 * depth - 1;
}

CameraRays::CameraRays(const tyndall::Camera& camera, int width, int height)
    : viewFromClip_(glm::inverse(toMat4(camera.clipFromView))),
      worldFromView_(glm::inverse(toMat4(camera.viewFromWorld))), clipDepth_(camera.clipDepth), width_(width),
      height_(height) {
  const glm::dmat4 rows = glm::transpose(toMat4(camera.clipFromView));
  const glm::dvec4 z = rows[2], w = rows[3];
  const glm::dvec3 axis(w);
  perspective_ = axis != glm::dvec3(0);
  if (perspective_) {
    // Along the axis at distance d, z/w = (z.a d + z0) / (w.a d + w0); its slope has the sign of z.a w0 - z0 w.a.
    reversed_ = glm::dot(glm::dvec3(z), axis) * w.w - z.w * glm::dot(axis, axis) < 0;
    // The eye is the point with clip x = y = w = 0.
    const glm::dvec4 viewEye = viewFromClip_ * glm::dvec4(0, 0, 1, 0);
    eye_ = glm::dvec3(worldFromView_ * (viewEye / viewEye.w));
  } else {
    reversed_ = z.z > 0; // an orthographic camera looks along -z
  }
}

glm::dvec2 CameraRays::ndc(int x, int y) const { return {(2 * x + 1.0) / width_ - 1, (2 * y + 1.0) / height_ - 1}; }

glm::dvec3 CameraRays::worldPoint(double ndcX, double ndcY, double ndcZ) const {
  const glm::dvec4 view = viewFromClip_ * glm::dvec4(ndcX, ndcY, ndcZ, 1);
  return glm::dvec3(worldFromView_ * (view / view.w));
}

Ray CameraRays::ray(int x, int y) const {
  const glm::dvec2 p = ndc(x, y);
  const double nearZ = ndcFromDepth(clipDepth_, reversed_ ? 1 : 0);
  const double middleZ = ndcFromDepth(clipDepth_, 0.5);
  const glm::dvec3 nearPoint = worldPoint(p.x, p.y, nearZ);
  if (perspective_) return {eye_, glm::normalize(nearPoint - eye_)};
  return {nearPoint, glm::normalize(worldPoint(p.x, p.y, middleZ) - nearPoint)};
}

double CameraRays::distance(int x, int y, double depth) const {
  if (reversed_ ? depth <= 0 : depth >= 1) return kInfinity;
  const glm::dvec2 p = ndc(x, y);
  const Ray r = ray(x, y);
  return glm::dot(worldPoint(p.x, p.y, ndcFromDepth(clipDepth_, depth)) - r.origin, r.direction);
}

Interval CameraRays::nearToFar(int x, int y) const {
  const glm::dvec2 p = ndc(x, y);
  const Ray r = ray(x, y);
  const double nearDistance = distance(x, y, reversed_ ? 1 : 0);
  const double farZ = ndcFromDepth(clipDepth_, reversed_ ? 0 : 1);
  const double farDistance = glm::dot(worldPoint(p.x, p.y, farZ) - r.origin, r.direction);
  // An infinite far plane un-projects to w = 0, give or take rounding: infinitely far, or behind the eye.
  const bool infinite = !std::isfinite(farDistance) || farDistance <= nearDistance;
  return {nearDistance, infinite ? kInfinity : farDistance};
}

} // namespace reference
