// How far an image is from its reference.
#pragma once

#include "Ray.h"

#include <cstddef>
#include <string>

namespace reference {

/// Errors of all pixels and channels pooled, each divided by the mean of the reference. Infinite if any value of either
/// image is not finite, or if the reference is black and the image is not.
struct ErrorMetrics {
  double rRmse = 0; ///< root of the mean squared error
  double p99 = 0;   ///< 99th percentile of the absolute error
  double max = 0;   ///< largest absolute error
  double mean = 0;  ///< of the reference, not divided
  std::size_t nonFinite = 0;
  std::string text() const; ///< one line for a log
};

/// Both images have the same size.
ErrorMetrics compare(const Image& image, const Image& reference);

/// |image - reference| / mean(reference).
Image differenceImage(const Image& image, const Image& reference);

/// Whom compare(), == and other comparisons of images tell of each pair, so that a failing test can show it; null:
/// none.
using ComparisonWatch = void (*)(const Image& image, const Image& reference);
void setComparisonWatch(ComparisonWatch watch);
void tellOfComparison(const Image& image, const Image& reference);

} // namespace reference
