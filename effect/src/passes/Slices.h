// Slices: the epipolar lines of one light in the image and in its shadow map, computed in double on the CPU and
// uploaded as a table (Yusov 2013, "Generating epipolar lines"; glsl/lib/slices.glsl).
#pragma once

#include "CheckFrame.h"
#include "SharedBlocks.h"
#include "Targets.h"
#include "optics/Slices.h"
#include "passes/PassContext.h"

#include <cstdint>

namespace tyndall::passes::slices {

struct In {
  const Frame* frame = nullptr;
  const Light* light = nullptr;
  FrameTextures::Shadow map;
};

struct Out {
  gl::Uint table = 0;
  int count = 0;                    ///< slices
  int samples = 0;                  ///< of a slice, at most
  int rowTexels = 0;                ///< that the row textures have room for; the block's grid.z are drawn
  int viewsPerDraw = 1;             ///< shadow views whose rows are at hand together
  std::uint64_t regularSamples = 0; ///< march samples that every slice has, over all slices
  optics::SliceTable geometry;      ///< on the CPU
  blocks::EpipolarBlock block{};    ///< complete but for the views (SliceContext::selectDraw)
};

Status run(const PassContext& context, Targets& targets, const In& in, Out& out);

/// Fills a texture of our own with RGBA floats of the CPU's.
Status uploadTable(const PassContext& context, Targets& targets, Target which, int width, int height,
                   const std::vector<glm::vec4>& texels, gl::Uint& texture);

/// The status where a texture of the pipeline could not be made.
Status outOfMemory();

} // namespace tyndall::passes::slices
