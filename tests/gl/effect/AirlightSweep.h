// Unshadowed light over extinctions from 0 to 100, distances from 1e-2 to 1e5 and directions, against the reference.
#pragma once

#include <tyndall/tyndall.h>

namespace tests {

/// Where the eye of every sweep is.
inline constexpr tyndall::Vec3 kSweepEye = {1, 2, 3};

/// A sweep's coefficients are multiples of those of the medium.
struct AirlightSweep {
  tyndall::Light light;
  tyndall::Medium medium;
  tyndall::Ambient ambient = {}; ///< if it is lit: in place of the light
};

/// A constituent with seven tenths of the extinction, absorption with the rest.
tyndall::Medium mediumOf(tyndall::Constituent constituent);

/// The largest error: relative, or absolute against the sweep's largest value where it is under 1e-12 of that. Of a
/// spot, or layers, less what rounding the light, the layers and the ray's length to float32 does to the truth itself.
double errorOf(const AirlightSweep& sweep);

} // namespace tests
