// A frame as C++ that an engine takes over.
#pragma once

#include <string>
#include <tyndall/tyndall.h>

namespace settings {

/// Functions tyndall::Tuning chosenTuning() and tyndall::Frame chosenFrame(), which fill in what is not at its default;
/// textures are the second one's arguments. Compiles as C++17 with Tyndall's header.
std::string codeOf(const tyndall::Frame& frame, const tyndall::Tuning& tuning);

} // namespace settings
