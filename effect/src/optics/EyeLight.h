// A light at the eye: what is captured before it (Frame::eyeCurves).
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// As tyndall::eyeLight(), of what has passed its checks.
Light eyeLight(const Camera& camera, double nearDistance, double farDistance);

} // namespace tyndall::optics
