// The product of all segments in double precision, at depths spread evenly over every texel, and how far methods are
// from it.
#pragma once

#include "Stage.h"

namespace avsmbench {

class Judge {
public:
  explicit Judge(const MapScene& scene);

  /// Mean absolute difference over texels and depths from 0 to 1.
  double meanError(const std::vector<float>& answers) const;
  const std::vector<Query>& queries() const { return queries_; }

private:
  std::vector<Query> queries_;
  std::vector<double> truth_;
};

} // namespace avsmbench
