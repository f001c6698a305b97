#include "AgainstReference.h"

#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>

namespace tests {

double median(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !(v > 0 && std::isfinite(v)); }),
               values.end());
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

// Largest error relative to the value or to the image's median, where the reference is finite. What float32 holds in
// few bits or not at all counts as 0.
double errorWhereFinite(const reference::Image& image, const reference::Image& truth) {
  reference::tellOfComparison(image, truth);
  const double scale = std::max(median(truth.rgb), 1e-32);
  double worst = 0;
  for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
    const double error = std::abs(image.rgb[i] - truth.rgb[i]);
    if (error == 0 || !std::isfinite(truth.rgb[i]) || truth.rgb[i] > 1e6 * scale) continue;
    worst = std::max(worst, error / std::max(scale, truth.rgb[i]));
  }
  return worst;
}

} // namespace

void checkAgainstReference(SceneRig& rig, double tolerance) {
  checkFinite(rig);
  CHECK(errorWhereFinite(rig.outputs().inscatter, rig.reference().inscatter) <= tolerance);
}

} // namespace tests
