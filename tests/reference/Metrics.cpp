#include "Metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace reference {
namespace {

double meanOf(const Image& image) {
  return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) /
         std::max<double>(1, static_cast<double>(image.rgb.size()));
}

void requireSameSize(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height || image.rgb.size() != reference.rgb.size())
    throw std::invalid_argument("reference: the images to compare differ in size");
}

ComparisonWatch theWatch = nullptr;

} // namespace

void setComparisonWatch(ComparisonWatch watch) { theWatch = watch; }

void tellOfComparison(const Image& image, const Image& reference) {
  if (theWatch) theWatch(image, reference);
}

bool operator==(const Image& image, const Image& reference) {
  tellOfComparison(image, reference);
  return image.width == reference.width && image.height == reference.height && image.rgb == reference.rgb;
}

std::string ErrorMetrics::text() const {
  std::ostringstream out;
  out << "rRMSE " << rRmse << ", p99 " << p99 << ", max " << max << ", mean " << mean << ", non-finite " << nonFinite;
  return out.str();
}

ErrorMetrics compare(const Image& image, const Image& reference) {
  tellOfComparison(image, reference);
  requireSameSize(image, reference);
  ErrorMetrics result;
  result.mean = meanOf(reference);
  std::vector<double> errors(image.rgb.size());
  double squares = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!std::isfinite(image.rgb[i]) || !std::isfinite(reference.rgb[i])) ++result.nonFinite;
    errors[i] = std::abs(image.rgb[i] - reference.rgb[i]);
    squares += errors[i] * errors[i];
  }
  if (result.nonFinite > 0) {
    result.rRmse = result.p99 = result.max = kInfinity;
    return result;
  }
  if (squares == 0) return result;
  const double scale = result.mean > 0 ? 1 / result.mean : kInfinity;
  const double count = static_cast<double>(errors.size());
  const auto rank = errors.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.99 * count)) - 1;
  std::nth_element(errors.begin(), rank, errors.end());
  const double p99 = *rank;
  result.rRmse = std::sqrt(squares / count) * scale;
  result.p99 = p99 > 0 ? p99 * scale : 0;
  result.max = *std::max_element(rank, errors.end()) * scale;
  return result;
}

Image differenceImage(const Image& image, const Image& reference) {
  requireSameSize(image, reference);
  const double mean = meanOf(reference);
  Image difference(image.width, image.height);
  for (std::size_t i = 0; i < difference.rgb.size(); ++i)
    difference.rgb[i] = std::abs(image.rgb[i] - reference.rgb[i]) / (mean > 0 ? mean : 1);
  return difference;
}

} // namespace reference
