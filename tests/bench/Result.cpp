#include "Result.h"

#include <algorithm>

namespace bench {

namespace {

double medianOf(std::vector<double> sorted) {
  std::sort(sorted.begin(), sorted.end());
  return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

} // namespace

double Result::median() const { return medianOf(milliseconds); }

double Result::gpuMedian() const { return medianOf(gpuMilliseconds); }

double Result::least() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }

double Result::most() const { return *std::max_element(milliseconds.begin(), milliseconds.end()); }

double Result::rRmse() const {
  const auto found = errors.find("exact");
  return found == errors.end() ? reference::kInfinity : found->second.rRmse;
}

} // namespace bench
