// Where in the world a light shines, against what the camera sees.
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// True if no camera ray meets the volume that a point or spot light reaches: its range, its cone. Conservative: a
/// light that is kept may still miss every ray. A directional light is everywhere.
bool isOutOfView(const Light& light, const Camera& camera);

} // namespace tyndall::optics
