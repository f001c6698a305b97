// A rig's picture beside the reference's, where numbers break.
#pragma once

#include "SceneRig.h"

#include <vector>

namespace tests {

/// Of the values that are finite and positive; 0 if none is.
double median(std::vector<double> values);

/// What was rendered last is finite, and as far from the reference as `tolerance` at most: of the value or of the
/// image's median, where the reference is finite.
void checkAgainstReference(SceneRig& rig, double tolerance);

} // namespace tests
