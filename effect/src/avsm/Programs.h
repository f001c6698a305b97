// Every program that an AVSM may ask for.
#pragma once

#include "gl/Variant.h"

#include <vector>

namespace tyndall::avsm {

/// Compute shaders, with definitions that they may not mention (gl::mentioned): several may be the same program.
std::vector<gl::Variant> allVariants();

} // namespace tyndall::avsm
