// Cameras that temporal antialiasing moves by a part of a pixel (Camera::jitter).
#pragma once

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// The camera without its jitter, which it still names: what all that is sampled along slices sees.
Camera steady(const Camera& camera, const Rectangle& viewport);

/// The camera that steady() was given, to rounding.
Camera jittered(const Camera& steady, const Rectangle& viewport);

/// True if two steady cameras are the same but for what an engine's floats leave of a jitter that was added and is
/// taken off: about a thousandth of a pixel.
bool agree(const Camera& a, const Camera& b);

/// Pixels by which slices go beyond the image, so that they reach all pixels of a jittered one: as many for all jitters
/// of up to half a pixel, which so have the same slices, and for all others.
double slicesBeyond(const Camera& camera);

/// A jitter that is none, but has the slices of those of half a pixel.
inline constexpr std::array<double, 2> kRestingJitter = {1e-12, 0};

} // namespace tyndall::optics
