// The effect's own textures: one table of name, format, size and reason. Allocated when a pass first needs them, again
// when the size changes.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <cstdint>

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
  View,
  ViewExact,
  ViewRowMeans,
  ViewMean,
  Count
};

class Targets {
public:
  explicit Targets(const gl::Functions& gl) : gl_(gl) {}

  /// The texture at a size, in the wide or the narrow one of its two formats. 0 if GL is out of memory.
  gl::Uint get(Target target, int width, int height, bool wide = true);

  /// The stencil buffer of the image; 0 if GL is out of memory.
  gl::Uint stencil(int width, int height);

  /// GL memory held, in bytes.
  std::uint64_t bytes() const;

private:
  struct Slot {
    gl::Texture texture;
    int width = 0;
    int height = 0;
    int bytesPerTexel = 0;
    gl::Enum format = 0;
  };
  const gl::Functions& gl_;
  std::array<Slot, static_cast<std::size_t>(Target::Count)> slots_;
  gl::Renderbuffer stencil_;
  int stencilWidth_ = 0;
  int stencilHeight_ = 0;
};

} // namespace tyndall
