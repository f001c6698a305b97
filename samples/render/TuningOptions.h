// The options of a tool that has the effect draw one way or another (tyndall::Tuning): the pictures are the same.
#pragma once

#include <CLI/CLI.hpp>
#include <tyndall/tyndall.h>

namespace render {

/// --reuse-mask, --fixup-mask, --compositing and --band-ms.
void addTuning(CLI::App& app, tyndall::Tuning& tuning);

} // namespace render
