// What is captured before the eye (Frame::eyeCurves).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// True of a frame with Frame::eyeCurves.
inline bool isDimmedBeforeEye(const Frame& frame) { return frame.eyeCurves.curves.texture != 0; }

/// Albedo of what the curves take; 0 without.
inline glm::dvec3 fogAlbedo(const Frame& frame) {
  const Rgb& albedo = frame.eyeCurves.albedo;
  return isDimmedBeforeEye(frame) ? glm::dvec3(albedo[0], albedo[1], albedo[2]) : glm::dvec3(0);
}
inline bool isFogLit(const Frame& frame) { return fogAlbedo(frame) != glm::dvec3(0); }
inline bool fogDimsBackground(const Frame& frame) { return isDimmedBeforeEye(frame) && frame.eyeCurves.dimsBackground; }

/// What scatters as one constituent of so much.
Constituent fogConstituent(const Frame& frame);

/// The medium by whose scattering light is told, where that is not Frame::medium: in channels in which only fog
/// scatters it has a little. None of its extinction is meant.
std::optional<Medium> standInMedium(const Frame& frame);

/// As tyndall::eyeLight(), of what has passed its checks; the camera without its jitter.
Light eyeLight(const Camera& camera, double nearDistance, double farDistance);

/// Depth of its curves at x, relative to the camera's origin: dot(xyz, x) + w.
glm::dvec4 eyeDepth(const Camera& camera, double nearDistance, double farDistance);

} // namespace tyndall::optics
