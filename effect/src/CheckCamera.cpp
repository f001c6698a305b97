// Rules of a camera, and of the planes that curves before it lie between.
#include "CheckValues.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

constexpr double kMostJitter = 16; // pixels, as the header says

} // namespace

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
  constexpr double kMost = 1e30, kMostRatio = 1e6; // float32 holds them, and curves tell what lies between
  const bool orthographic = optics::isOrthographic(optics::toGlm(camera.clipFromView));
  constexpr double kLeast = 1e-30;
  if (!(nearDistance >= (orthographic ? 0 : kLeast) && nearDistance < kMost))
    return invalid("eyeCurves.nearDistance", text(nearDistance),
                   orthographic ? "must be finite and >= 0" : "must be finite and > 0, as a 32-bit float");
  constexpr double kLeastRatio = 1 + 1e-4;
  const bool isBehind = farDistance > nearDistance && farDistance >= std::max(kLeastRatio * nearDistance, kLeast);
  if (!(isBehind && farDistance < kMost && (orthographic || farDistance <= kMostRatio * nearDistance)))
    return invalid("eyeCurves.farDistance", text(farDistance),
                   orthographic ? "must be finite and > nearDistance"
                                : "must be finite, > nearDistance and at most 1e6 times that");
  return {};
}

} // namespace tyndall
