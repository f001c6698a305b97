// Which slices of a light moving objects reach, they and their shadows (Frame::objects). All camera rays of a slice lie
// in one half-plane through the eye and the light; the light through an object stays in the half-planes that the object
// meets, and with it the object's shadow.
#pragma once

#include "SharedBlocks.h"
#include "optics/Slices.h"

#include <vector>

namespace tyndall::optics {

/// A flag for each slice: true unless none of its samples, of the pixels that it serves and of the texels of its rows
/// can see a difference. Boxes are widened by the pixels and shadow texels that samples are taken from.
std::vector<bool> movedSlices(const Frame& frame, const Light& light, const blocks::LightBlock& block,
                              const SliceTable& slices);

} // namespace tyndall::optics
