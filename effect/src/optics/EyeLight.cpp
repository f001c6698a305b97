#include "optics/EyeLight.h"

#include "optics/Blocks.h"
#include "optics/Matrices.h"

namespace tyndall::optics {

namespace {

Mat4 toMat4(const glm::dmat4& m) { return mat4(&m[0][0]); }

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace

// Of the camera's matrix the row of z is another: linear along the axis of an orthographic view and, of a perspective
// one, a + b / w, w times the same factor as the camera's.
Light eyeLight(const Camera& camera, double nearDistance, double farDistance) {
  const glm::dmat4 viewFromWorld = toGlm(camera.viewFromWorld);
  const glm::dmat4 clipFromWorld = toGlm(camera.clipFromView) * viewFromWorld;
  const glm::dvec3 origin = cameraOrigin(camera);
  const bool orthographic = isOrthographic(clipFromWorld);
  glm::dmat4 rows = glm::transpose(clipFromWorld);
  const double low = camera.clipDepth == ClipDepth::ZeroToOne ? 0 : -1, depth = farDistance - nearDistance;
  Light light;
  light.shadow.clipDepth = camera.clipDepth;
  light.litOutsideViews = false;
  if (orthographic) {
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(glm::transpose(viewFromWorld)[2]));
    light.direction = toVec3(forward);
    const double slope = (1 - low) / depth * rows[3].w;
    rows[2] = glm::dvec4(slope * forward, low * rows[3].w - slope * (nearDistance + glm::dot(forward, origin)));
  } else {
    light.kind = LightKind::Spot;
    light.position = toVec3(origin);
    const double unit = glm::length(glm::dvec3(rows[3])); // of w
    light.direction = toVec3(glm::dvec3(rows[3]) / unit);
    const double b = (low - 1) * unit * nearDistance * farDistance / depth, a = 1 - b / (unit * farDistance);
    rows[2] = a * rows[3];
    rows[2].w += b;
  }
  light.shadow.views = {{toMat4(glm::transpose(rows))}};
  return light;
}

} // namespace tyndall::optics
