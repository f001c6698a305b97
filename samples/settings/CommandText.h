// A state as a command that draws it.
#pragma once

#include "State.h"

#include <string>

namespace settings {

/// What tyndall-render takes for the same picture, for a shell: only what is not at its default.
std::string commandOf(const State& state);

/// The text as one word of a POSIX shell.
std::string quoted(const std::string& text);

} // namespace settings
