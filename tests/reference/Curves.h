// Transmittance of segments along one light ray in double precision (DESIGN 1, A; Salvi et al. 2013, eq. 1).
#pragma once

#include <vector>

namespace reference {

/// Between two depths a part of the light passes, evenly; a step where both are the same.
struct Segment {
  double entry = 0;
  double exit = 0;
  double transmittance = 1;
};

/// The product of what all segments let through up to a depth; a step counts at its own depth.
double transmittanceAt(const std::vector<Segment>& segments, double depth);

} // namespace reference
