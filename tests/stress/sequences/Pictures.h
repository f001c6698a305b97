// Pictures of a frame beside those of an effect that keeps nothing.
#pragma once

#include "Engine.h"

#include <string>

namespace stress {

/// The largest difference of two pictures within a viewport, relative to the wanted value or to the mean of all, and
/// beyond what the target's format rounds; and the root mean square of all differences, relative to the mean.
struct Difference {
  double most = 0, rootMeanSquare = 0;
  std::string where; ///< of the largest
};

/// Infinite where one of two values is not finite, unless both are the same.
Difference differenceOf(const Contents& got, const Contents& wanted, const ScriptState& state);

bool bitEqual(const Contents& a, const Contents& b);

/// True if all pixels outside the viewport have the colour of `empty`.
bool isUntouchedOutside(const Contents& drawn, const Contents& empty, const ScriptState& state);

} // namespace stress
