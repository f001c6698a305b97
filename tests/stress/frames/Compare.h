// How far numbers are from what they may be.
#pragma once

#include "CaseRig.h"

namespace stress {

/// What each value may be: from the least to the greatest of some answers.
struct Range {
  std::vector<double> low, high;
  void include(const std::vector<double>& values);
};

/// Root mean square of the distance from the range, over `scale`. Values that are not finite in the range do not count;
/// those that are not finite elsewhere make it infinite.
double errorBeyond(const std::vector<double>& values, const Range& range, double scale);

double meanOfFinite(const std::vector<double>& values);

/// Which radiance is a number that can be compared.
struct Comparable {
  double least = 1e-30;     ///< under this it is nothing: what rounding of the unshadowed picture comes to
  bool isLampAtEye = false; ///< as far as the matrices tell: whatever it lights has no end
};

/// A lamp on a ray has an integral without end, and a number that is so much greater than those of most pixels is
/// nobody's truth: infinite in what this returns.
std::vector<double> withoutGlare(std::vector<double> values, const Comparable& comparable);

/// map-exact's answers about some pixels, three values each, without glare.
std::vector<double> truthOf(const reference::MapScene& scene, const std::vector<glm::ivec2>& pixels,
                            const Comparable& comparable);

/// What the answers come to when the inputs move by what floats hold of them: depth by two steps, points by 1e-6 of
/// their distances to light and eye, rays and lamps' views by angles of 2e-7, and lamps by what doubles hold of where
/// the eye is.
Range roundedTruth(const reference::MapScene& scene, const std::vector<glm::ivec2>& pixels,
                   const Comparable& comparable);

/// What exact's picture comes to when image and shadow maps move by what slices and rows may: up to half a pixel, and
/// half a texel for each that a row steps on. `count` pictures.
Range displacedExact(CaseRig& rig, const tyndall::Settings& exact, int rowStep, const Comparable& comparable,
                     int count);

} // namespace stress
