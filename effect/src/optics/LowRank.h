// The airlight as a sum of few products, one factor of the camera ray and one of the light ray (Chen 2011, 3.2
// and 3.4): in a plane through the eye and the light it depends on the ray's angle beta and on where light crosses it,
// gamma. Sampled on a grid and factored by a singular value decomposition; then a lit span needs differences of prefix
// sums only.
#pragma once

#include "SharedBlocks.h"
#include "optics/Slices.h"

#include <Eigen/Core>
#include <optional>

namespace tyndall::optics {

inline constexpr int kLowRankGrid = 64; ///< samples of beta and of gamma

/// rays * lights approximates a matrix, whose rows and columns count by the squares of their weights.
struct LowRankFactors {
  Eigen::MatrixXd rays;   ///< rows x terms
  Eigen::MatrixXd lights; ///< terms x columns
};

/// The best factors of that many terms (Eckart-Young). None if an element is not finite; weights must be > 0.
std::optional<LowRankFactors> factorise(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rowWeights,
                                        const Eigen::VectorXd& columnWeights, int terms);

struct LowRankTable {
  int sets = 0; ///< of light factors: one, or with a spot's cone one a slice
  int terms = 0;
  float rayBegin = 0, rayScale = 0;      ///< of the grid of camera rays, as the block has them
  float lightBegin = 0, lightExtent = 0; ///< the same of light rays
  std::vector<glm::vec4> rays;           ///< grid x terms: rgb
  std::vector<glm::vec4> lights;         ///< sets x (2 terms grid): prefix sums of a term, then the term itself

  /// Fills in what the block says of low rank.
  void describe(blocks::EpipolarBlock& block) const;
};

/// By settings.lowRankTerms. None where the airlight depends on more than two coordinates (an orthographic camera
/// before a lamp, a medium with a boundary or layers) or no ray has an angle to the light.
std::optional<LowRankTable> makeLowRank(const Frame& frame, const Light& light, const SliceTable& slices);

} // namespace tyndall::optics
