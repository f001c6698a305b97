// Which slices of a light moving objects reach, they and their shadows (Frame::objects). All camera rays of a slice lie
// in one half-plane through the eye and the light; the light through an object stays in the half-planes that the object
// meets, and with it the object's shadow. In the image and in a shadow map an object lies between its corners.
#pragma once

#include "SharedBlocks.h"
#include "optics/Slices.h"

#include <algorithm>
#include <vector>

namespace tyndall::optics {

/// From one number to before another; empty unless begin < end.
struct Range {
  int begin = 0, end = 0;
  bool isEmpty() const { return begin >= end; }
  Range operator|(const Range& other) const {
    if (isEmpty()) return other;
    return other.isEmpty() ? *this : Range{std::min(begin, other.begin), std::max(end, other.end)};
  }
};

struct MovedSlices {
  /// True unless no sample of the slice, no pixel that it serves and no texel of its rows can see a difference.
  std::vector<bool> moved;
  std::vector<Range> samples; ///< of each slice, those whose rays may end elsewhere
  std::vector<Range> texels;  ///< of each row, those of each view behind one another, what may be elsewhere in the map
};

/// Boxes are widened by the pixels and shadow texels that samples are taken from.
MovedSlices movedSlices(const Frame& frame, const Light& light, const blocks::LightBlock& block,
                        const SliceTable& slices);

} // namespace tyndall::optics
