// What is captured before the eye (Frame::eyeCurves).
#pragma once

#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// True of a frame with Frame::eyeCurves.
inline bool isDimmedBeforeEye(const Frame& frame) { return frame.eyeCurves.curves.texture != 0; }

/// As tyndall::eyeLight(), of what has passed its checks; the camera without its jitter.
Light eyeLight(const Camera& camera, double nearDistance, double farDistance);

/// Depth of its curves at x, relative to the camera's origin: dot(xyz, x) + w.
glm::dvec4 eyeDepth(const Camera& camera, double nearDistance, double farDistance);

} // namespace tyndall::optics
