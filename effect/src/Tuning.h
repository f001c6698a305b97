// What suits the renderer: choices that change how fast a picture is drawn, never the picture.
#pragma once

#include <string>
#include <tyndall/tyndall.h>

namespace tyndall {

/// InvalidConfig, with the field and its rule.
Status checkTuning(const Tuning& tuning);

/// The tuning that is used: what is asked for, and from the row of the renderer (GL_RENDERER) what is not. Without
/// dual-source blending (GL_MAX_DUAL_SOURCE_DRAW_BUFFERS) the colour is copied.
Tuning tuningFor(const Tuning& asked, const std::string& renderer, int dualSourceBuffers);

} // namespace tyndall
