// The epipolar geometry of one light in double precision: where its slices run in the image and in the shadow map. The
// epipole stays homogeneous; nothing divides by its w (DESIGN 1, rule 2).
#pragma once

#include "SharedBlocks.h"

#include <cstdint>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::optics {

struct SliceTable {
  int slices = 0;
  int rows = 0;
  std::vector<glm::vec4> texels;    ///< slices x rows, see glsl/lib/slices.glsl
  std::uint64_t regularSamples = 0; ///< one in sixteen samples of each slice
  int longestRow = 0;               ///< texels, over all slices and views
  blocks::EpipolarBlock block{};    ///< what says where slices run and how rows and textures hold values
};

/// Slices by the frame's settings. shadowWidth, shadowHeight: texels, 0 without a shadow map.
SliceTable makeSlices(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight);

} // namespace tyndall::optics
