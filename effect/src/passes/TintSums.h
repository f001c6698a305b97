// Tint sums: what light glass lets through along every row, as prefix sums of each low-rank term times the tint, in log
// passes (Chen 2011, 3.4; glsl/passes/tintGroups, tintSums).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::tint_sums {

struct In {
  rows::Out rows;
};

/// Of the selected draw; leaves the sums bound for the walk along its rows. Needs the low-rank tables bound.
Status run(SliceContext& context, const In& in);

/// All programs of a light with glass.
std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

} // namespace tyndall::passes::tint_sums
