#include "optics/EyeLight.h"

#include "optics/Blocks.h"
#include "optics/Matrices.h"

namespace tyndall::optics {

namespace {

Mat4 toMat4(const glm::dmat4& m) { return mat4(&m[0][0]); }

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Rows of clipFromWorld, and along which axis distances are: that of clip w, of length `unit`, or the view's.
struct Seen {
  glm::dmat4 rows;
  bool orthographic;
  double unit;
  glm::dvec3 forward;

  explicit Seen(const Camera& camera) {
    const glm::dmat4 viewFromWorld = toGlm(camera.viewFromWorld),
                     clipFromWorld = toGlm(camera.clipFromView) * viewFromWorld;
    rows = glm::transpose(clipFromWorld);
    orthographic = isOrthographic(clipFromWorld);
    const glm::dvec3 along = orthographic ? -glm::dvec3(glm::transpose(viewFromWorld)[2]) : glm::dvec3(rows[3]);
    unit = glm::length(along);
    forward = along / unit;
  }
};

} // namespace

// Of the camera's matrix the row of z is another: linear along the axis of an orthographic view and, of a perspective
// one, a + b / w, w times the same factor as the camera's.
Light eyeLight(const Camera& camera, double nearDistance, double farDistance) {
  Seen seen(camera);
  const glm::dvec3 origin = cameraOrigin(camera);
  const double low = camera.clipDepth == ClipDepth::ZeroToOne ? 0 : -1, depth = farDistance - nearDistance;
  glm::dvec4 &z = seen.rows[2], &w = seen.rows[3];
  Light light;
  light.shadow.clipDepth = camera.clipDepth;
  light.litOutsideViews = false;
  light.direction = toVec3(seen.forward);
  if (seen.orthographic) {
    const double slope = (1 - low) / depth * w.w;
    z = glm::dvec4(slope * seen.forward, low * w.w - slope * (nearDistance + glm::dot(seen.forward, origin)));
  } else {
    light.kind = LightKind::Spot;
    light.position = toVec3(origin);
    const double b = (low - 1) * seen.unit * nearDistance * farDistance / depth, a = 1 - b / (seen.unit * farDistance);
    z = a * w;
    z.w += b;
  }
  light.shadow.views = {{toMat4(glm::transpose(seen.rows))}};
  return light;
}

Constituent fogConstituent(const Frame& frame) {
  Constituent fog;
  fog.scattering = frame.eyeCurves.albedo;
  fog.phase = frame.eyeCurves.phase;
  fog.g = frame.eyeCurves.g;
  return fog;
}

std::optional<Medium> standInMedium(const Frame& frame) {
  if (!isFogLit(frame)) return std::nullopt;
  const glm::dvec3 fog = fogAlbedo(frame), scattering = scatteringOf(frame.medium);
  Constituent little;
  for (int c = 0; c < 3; ++c)
    if (fog[c] > 0 && scattering[c] == 0)
      little.scattering[static_cast<std::size_t>(c)] = static_cast<float>(1 / frame.eyeCurves.farDistance);
  if (little.scattering == Rgb{0, 0, 0}) return std::nullopt;
  Medium medium = frame.medium;
  medium.constituents.push_back(little);
  return medium;
}

glm::dvec4 eyeDepth(const Camera& camera, double nearDistance, double farDistance) {
  const double depth = farDistance - nearDistance;
  return {Seen(camera).forward / depth, -nearDistance / depth};
}

} // namespace tyndall::optics
