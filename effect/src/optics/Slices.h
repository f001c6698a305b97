// The epipolar geometry of one light in double precision: where its slices run in the image and in the shadow map. The
// epipole stays homogeneous; nothing divides by its w (DESIGN 1, rule 2).
#pragma once

#include "SharedBlocks.h"

#include <cstdint>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall::optics {

struct SliceTable {
  int slices = 0; ///< in the table
  int drawn = 0;  ///< at most; fewer than there are if they are a choice (EpipolarBlock::sliceTarget)
  int rows = 0;
  std::vector<glm::vec4> texels;    ///< slices x rows, see glsl/lib/slices.glsl
  std::uint64_t regularSamples = 0; ///< one in sixteen samples of each slice
  int longestRow = 0;               ///< texels, over all slices and views
  blocks::EpipolarBlock block{};    ///< what says where slices run and how rows and textures hold values
};

/// Of which all, or as a preview few (Settings::errorTarget).
struct SliceSampling {
  int every = 1; ///< of so many slices the first
  int samples = 512, rowStep = 1;
  int widest = 16384; ///< slices that a texture holds
};

/// What a frame's settings ask for.
SliceSampling samplingOf(const Settings& settings);

/// True if a frame asks for slices to be chosen from twice as many as it may have (Settings::errorTarget).
bool mayChooseSlices(const Frame& frame);

/// Slices by the frame's settings. shadowWidth, shadowHeight: texels, 0 without a shadow map.
SliceTable makeSlices(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight,
                      const SliceSampling& sampling);
inline SliceTable makeSlices(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight) {
  return makeSlices(frame, light, shadowWidth, shadowHeight, samplingOf(frame.settings));
}

} // namespace tyndall::optics
