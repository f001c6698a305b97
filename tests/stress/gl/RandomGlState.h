// GL state as no engine leaves it, by a seed: every row that a call can set has some value that GL allows.
#pragma once

#include "stress/sequences/Random.h"

namespace stress {

/// Sets all rows but bindings of objects. tests::leaveCleanState() undoes it.
void setRandomGlState(Random& random);

} // namespace stress
