// Where in the world a light shines, against what the camera sees.
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// True if no camera ray meets the volume that a point or spot light reaches: its range, its cone. Conservative: a
/// light that is kept may still miss every ray. A directional light is everywhere.
bool isOutOfView(const Light& light, const Camera& camera);

/// What a light is worth in a picture, roughly and without shadows.
struct LightShare {
  double area = 1;       ///< share of the image whose rays run through the light's volume, in [0, 1]
  double brightness = 0; ///< of such a pixel, up to a factor that all lights have in common
};

/// Up to 144 rays are tried. The brightness is the irradiance over one optical depth, or as far as rays run; of a lamp
/// the irradiance over a line that passes it at the eye's distance.
LightShare shareOf(const Light& light, const Camera& camera, const Medium& medium);

/// What no pixel's inscatter from the light exceeds, but for those within half a pixel of a lamp, where it has no
/// bound.
double brightestInscatter(const Frame& frame, const Light& light);

} // namespace tyndall::optics
