// Changes: which slices, segments and pixels are not what they were in the last frame (Frame::reuse;
// glsl/passes/changedEnds, changedParts,
// changedSegments, changedSlices, changedStrips, changedTiles, tiles, copyTexels).
#pragma once

#include "passes/Rows.h"

namespace tyndall::passes::changes {

/// The slices that Frame::objects reaches, and those due to be refreshed: only they are to be compared, and until then
/// drawn.
Status findMoved(SliceContext& context, int frame);

struct In {
  gl::Uint sampleEnds = 0, lastSampleEnds = 0; ///< the last ones 0: not to be compared
  rows::Out rows, lastRows;                    ///< likewise
};

/// Compares, and has only slices and segments drawn from then on that differ or are due; the light's `count` will know
/// how many segments.
Status compare(SliceContext& context, const In& in, int frame);

/// An image in tiles of kTile x kTile pixels, whose flags stand one after the other in lines of kTilesAcross.
inline constexpr int kTile = 16, kTilesAcross = 256;
int tilesOf(int width, int height);
inline int tileLines(int width, int height) { return (tilesOf(width, height) + kTilesAcross - 1) / kTilesAcross; }

/// Draws flags of the tiles that the bound segments, and the depth, touch; of a light of which only some slices were
/// compared, also bound. False if the shader does not build.
bool findTiles(const PassContext& context, const exact::Variant& variant, bool comparesDepth, bool some);

/// Draws a full-screen pass over the bound tiles only. False if the shader does not build.
bool drawTiles(const PassContext& context, const gl::Variant& fullScreen, int width, int height);

/// The same program over tiles.
gl::Variant overTiles(gl::Variant fullScreen);

std::vector<gl::Variant> variantsOf(const exact::Variant& variant);

} // namespace tyndall::passes::changes
