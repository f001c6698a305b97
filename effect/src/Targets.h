// The effect's own textures: one table of name, format, size and reason. Allocated when a pass first needs them; shared
// by lights that ask for the same size and format, and given up after a frame that did not use them.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tyndall {

enum class Target {
  Inscatter,
  Transmittance,
  SliceTable,
  SampleEnds,
  Marks,
  RefinedMarks,
  Marched,
  SliceSums,
  MeanLight,
  ExtraOffsets,
  Extra,
  ExtraGreen,
  ExtraBlue,
  EpipolarInscatter,
  RowDepths,
  RowShares,
  RowNodes,
  RowNodeMeans,
  RowNodeMoments,
  RowTree,
  RowMeans,
  RowMoments,
  PairTree,
  CurveCells,
  CurveTree,
  LowRankRays,
  LowRankLights,
  TintRed,
  TintGreen,
  TintBlue,
  TintSumsRed,
  TintSumsGreen,
  TintSumsBlue,
  RowHashes,
  ChangedParts,
  ChangedEnds,
  ChangedSegments,
  ChangedSlices,
  MovedSlices,
  ChangedTiles,
  LastDepth,
  View,
  ViewExact,
  ViewRowMeans,
  ViewMean,
  Count
};

struct TargetFormat;

class Targets {
public:
  explicit Targets(const gl::Functions& gl) : gl_(gl) {}

  /// The texture at a size, in the wide or the narrow one of its two formats. 0 if GL is out of memory.
  gl::Uint get(Target target, int width, int height, bool wide = true);

  /// The stencil buffer of the image; 0 if GL is out of memory.
  gl::Uint stencil(int width, int height);

  /// Gives up the textures that were not asked for since the last call.
  void endFrame();

  /// Keeps all that it has, whatever is asked for, until endFrame().
  void hold();

  /// GL memory held, in bytes.
  std::uint64_t bytes() const;

private:
  struct Slot {
    gl::Texture texture;
    bool used = false; // in this frame
    int width = 0;
    int height = 0;
    int bytesPerTexel = 0;
    gl::Enum format = 0;
  };
  Slot make(const TargetFormat& format, int width, int height); ///< without a texture if GL is out of memory
  void dropUnused();

  const gl::Functions& gl_;
  std::array<std::vector<Slot>, static_cast<std::size_t>(Target::Count)> slots_;
  gl::Renderbuffer stencil_;
  int stencilWidth_ = 0;
  int stencilHeight_ = 0;
};

} // namespace tyndall
