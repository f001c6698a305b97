#include "Judge.h"

#include "reference/Parallel.h"

#include <cmath>

namespace avsmbench {

namespace {

constexpr int kDepths = 64; ///< of a texel, a 64th apart, each texel's shifted by a step of its own

} // namespace

Judge::Judge(const MapScene& scene) {
  const auto segments = segmentsByTexel(scene);
  queries_.resize(segments.size() * kDepths);
  truth_.resize(queries_.size());
  reference::parallelFor(static_cast<int>(segments.size()), [&](int texel) {
    const auto own = static_cast<std::size_t>(texel);
    const double shift = std::fmod((texel + 0.5) * 0.6180339887498949, 1);
    for (std::size_t i = 0; i < kDepths; ++i) {
      Query& query = queries_[own * kDepths + i];
      query = {static_cast<std::uint32_t>(texel), static_cast<float>((static_cast<double>(i) + shift) / kDepths)};
      truth_[own * kDepths + i] = reference::transmittanceAt(segments[own], static_cast<double>(query.depth));
    }
  });
}

double Judge::meanError(const std::vector<float>& answers) const {
  double sum = 0;
  for (std::size_t i = 0; i < truth_.size(); ++i)
    sum += std::abs(static_cast<double>(answers[i]) - truth_[i]);
  return sum / static_cast<double>(truth_.size());
}

} // namespace avsmbench
