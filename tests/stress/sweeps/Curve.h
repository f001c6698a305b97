// What a sweep does to the picture, step by step.
#pragma once

#include "Sweeps.h"

#include <iosfwd>

namespace sweeps {

/// All but t and mean: root mean squares over the picture, as shares of its mean or, where that is greater, of a tenth
/// of the brightest mean of the sweep: a picture that is nearly black has no scale of its own.
struct Point {
  double t = 0;
  double mean = 0;        ///< of exact's inscatter
  double error = 0;       ///< of the technique, against exact
  double mapError = -1;   ///< against map-exact, where that was asked for
  double change = 0;      ///< of the technique's picture since the step before
  double exactChange = 0; ///< of exact's
  double scale = 0;       ///< radiance that shares are of

  /// What the technique's picture changes by and exact's does not.
  double jump() const { return change > exactChange ? change - exactChange : 0; }
};

using Curve = std::vector<Point>;

/// `mapExactEvery`: 0 for never.
Curve curveOf(const Sweep& sweep, tyndall::Technique technique, int mapExactEvery = 0);

/// What half a pixel of the picture or half a texel of the shadow map, to the side or up, changes in exact's picture,
/// in the same shares: a slice is as far from the pixels that it serves, its row from their rays.
double displaced(const Sweep& sweep, const Point& at);

/// sweep,technique,t,mean,error,map_error,change,exact_change
void writeHeader(std::ostream& csv);
void write(std::ostream& csv, const std::string& sweep, const std::string& technique, const Curve& curve);

} // namespace sweeps
