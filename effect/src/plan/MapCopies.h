// Which lights' maps are copied into layers of our own before they are read (glsl/passes/mapCopy.frag).
#pragma once

#include "CheckFrame.h"

#include <tyndall/tyndall.h>

namespace tyndall {

/// A frame whose cube maps have their faces as views.
Frame withCubeViews(const Frame& frame);

/// Lights whose maps are copied become what passes read of them: window depth in an array, a layer for each view. How
/// each is copied is entered into the textures. The frame has passed its checks.
void chooseCopies(Frame& frame, FrameTextures& textures);

} // namespace tyndall
