// What a medium means, for people.
#pragma once

#include <tyndall/tyndall.h>

namespace viewer {

/// The phase function, 1/sr, as tyndall.h has it.
double phaseOf(const tyndall::Constituent& constituent, double cosTheta);

/// All scattering and the absorption, 1/world unit.
tyndall::Rgb extinctionOf(const tyndall::Medium& medium);

/// How far one sees: where a black thing has 2 % of its contrast left, by the mean of the channels; infinite in clear
/// air.
double visibilityOf(const tyndall::Medium& medium);

/// The same medium with all coefficients scaled to another visibility; itself if it is clear.
tyndall::Medium withVisibility(const tyndall::Medium& medium, double visibility);

} // namespace viewer
