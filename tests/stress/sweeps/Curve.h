// What a sweep does to the picture, step by step.
#pragma once

#include "Sweeps.h"

#include <iosfwd>

namespace sweeps {

/// Shares of the picture's mean, all but t and mean.
struct Point {
  double t = 0;
  double mean = 0;        ///< of exact's inscatter
  double error = 0;       ///< rRMSE of the technique against exact
  double mapError = -1;   ///< and against map-exact, where that was asked for
  double change = 0;      ///< of the technique since the step before, root mean square
  double exactChange = 0; ///< of exact
  double jump = 0;        ///< of the difference between the two: what exact does not show
  double displaced = 0;   ///< what half a pixel or half a texel changes in exact
};

using Curve = std::vector<Point>;

/// `mapExactEvery`: 0 for never.
Curve curveOf(const Sweep& sweep, tyndall::Technique technique, int mapExactEvery = 0);

/// sweep,technique,t,mean,error,map_error,change,exact_change,jump,displaced
void writeHeader(std::ostream& csv);
void write(std::ostream& csv, const std::string& sweep, const std::string& technique, const Curve& curve);

} // namespace sweeps
