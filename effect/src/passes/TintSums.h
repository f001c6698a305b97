// Tint sums: what light glass lets through along every row, as prefix sums of each low-rank term times the tint, in log
// passes (Chen 2011, 3.4; glsl/passes/tintGroups, tintSums).
#pragma once

#include "plan/LightPlanner.h"

namespace tyndall::passes::tint_sums {

/// Of the selected draw, whose rows are at hand, and with the tables of Technique::LowRank.
void plan(LightPlanner& light);

} // namespace tyndall::passes::tint_sums
