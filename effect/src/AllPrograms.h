// Every program that an effect or an AVSM may ask for.
#pragma once

#include "gl/Program.h"

namespace tyndall {

/// With definitions that their shaders may not mention (gl::mentioned): several may be the same program.
std::vector<gl::Variant> effectPrograms();

/// The same of adaptive volumetric shadow maps: compute shaders.
std::vector<gl::Variant> avsmPrograms();

} // namespace tyndall
