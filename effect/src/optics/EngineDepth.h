// How the engine's scene depth is read: which texels show the image, and what they hold.
#pragma once

#include "SharedBlocks.h"

#include <tyndall/tyndall.h>

namespace tyndall::optics {

/// Texels of the scene depth that show the viewport.
Rectangle depthRectangle(const Frame& frame);

/// True if passes can read the texture itself: window depth, one texel a pixel from the first one on, no array.
bool isPlain(const Frame& frame);

/// Of a multisampled depth that they cannot: how many samples stand side by side in one that they can, 2^s; else 0.
int sampleShift(const Frame& frame, int samples);

/// What shaders need to read it (glsl/lib/engineDepth.glsl). The block has the camera's rays.
/// rounding: share of a distance by which the texture's format rounds it.
void setEngineDepth(blocks::FrameBlock& block, const Frame& frame, float rounding);

} // namespace tyndall::optics
