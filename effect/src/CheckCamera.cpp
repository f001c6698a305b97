// Rules of a camera and its image, and of the planes that curves before it lie between.
#include "CheckValues.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

constexpr double kMostJitter = 16; // pixels, as the header says

} // namespace

Status checkViewport(const Rectangle& viewport) {
  if (viewport.x < 0) return invalid("viewport.x", std::to_string(viewport.x), "must be >= 0");
  if (viewport.y < 0) return invalid("viewport.y", std::to_string(viewport.y), "must be >= 0");
  if (viewport.width < 1 || viewport.width > kMaxImageSize)
    return invalid("viewport.width", std::to_string(viewport.width), "must be 1 to 16384");
  if (viewport.height < 1 || viewport.height > kMaxImageSize)
    return invalid("viewport.height", std::to_string(viewport.height), "must be 1 to 16384");
  return {};
}

Status checkCamera(const Camera& camera) {
  if (Status s = checkMatrix("camera.viewFromWorld", camera.viewFromWorld); !s) return s;
  const Mat4& view = camera.viewFromWorld;
  constexpr double kRounding = 1e-5; // of a matrix that a general inverse made, in float
  if (std::abs(view[3]) + std::abs(view[7]) + std::abs(view[11]) > kRounding || std::abs(view[15] - 1) > kRounding)
    return invalid("camera.viewFromWorld", "not affine", "its last row must be (0, 0, 0, 1)");
  if (Status s = checkClipDepth("camera.clipDepth", camera.clipDepth); !s) return s;
  const auto [x, y] = camera.jitter;
  if (!(std::abs(x) <= kMostJitter && std::abs(y) <= kMostJitter))
    return invalid("camera.jitter", "(" + text(x) + ", " + text(y) + ")",
                   "must be finite and at most 16 pixels, either way");
  return checkMatrix("camera.clipFromView", camera.clipFromView);
}

Status checkEyePlanes(const Camera& camera, double nearDistance, double farDistance) {
  constexpr double kLeast = 1e-30, kMost = 1e30;             // float32 holds them,
  constexpr double kLeastRatio = 1 + 1e-4, kMostRatio = 1e6; // and curves tell what lies between
  const bool orthographic =
      optics::isOrthographic(optics::toGlm(camera.clipFromView) * optics::toGlm(camera.viewFromWorld));
  if (!(nearDistance >= (orthographic ? 0 : kLeast) && nearDistance < kMost))
    return invalid("eyeCurves.nearDistance", text(nearDistance),
                   orthographic ? "must be >= 0 and < 1e30" : "must be >= 1e-30 and < 1e30");
  const bool isBehind =
      farDistance >= std::max(kLeastRatio * nearDistance, nearDistance + kLeast) && farDistance < kMost;
  if (!isBehind || !(orthographic || farDistance <= kMostRatio * nearDistance))
    return invalid("eyeCurves.farDistance", text(farDistance),
                   std::string("must be at least 1.0001 times nearDistance") +
                       (orthographic ? ", greater and < 1e30" : ", at most 1e6 times that and < 1e30"));
  return {};
}

} // namespace tyndall
