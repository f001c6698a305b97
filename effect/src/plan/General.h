// Which program serves a variant: where a definition changes nothing of what a shader does, or little and seldom, a
// more general one does.
#pragma once

#include "gl/Variant.h"

namespace tyndall {

/// The definitions of the program that serves these.
gl::Definitions general(const std::string& fragment, gl::Definitions definitions);

} // namespace tyndall
