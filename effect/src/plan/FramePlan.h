// What a frame draws, as plain data: made by planFrame() before the first GL draw, carried out by drawPlan().
#pragma once

#include "PassRecorder.h"
#include "Rounding.h"
#include "SharedBlocks.h"
#include "gl/Variant.h"
#include "plan/Resources.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tyndall {

/// How a draw's colour outputs join what is in the target.
enum class Blend {
  Replace,    ///< overwrite
  Add,        ///< target + source 0 (rgb); alpha stays
  AddByAlpha, ///< target + source 0 times the target's alpha (rgb); alpha stays
  AddAll,     ///< target + source 0, alpha too
  DualSource, ///< target * source 1 + source 0 (rgb); alpha stays
  Colour,     ///< overwrite rgb; alpha stays
  Alpha,      ///< overwrite alpha; rgb stays. Of the first output; others are overwritten
};

/// A pixel's bits in the stencil buffer: what it lets a draw into, and what the draw leaves there. Off without either.
struct Stencil {
  static constexpr gl::Uint kServed = 1;  ///< by unwarp
  static constexpr gl::Uint kChanged = 2; ///< temporal reuse: it is drawn anew
  static constexpr gl::Uint kEdge = 4;    ///< its samples show several surfaces
  static constexpr gl::Uint kAll = 0xFF;

  gl::Uint tested = 0;   ///< bits that must be as `required` has them
  gl::Uint required = 0; ///< of those, the ones that must be set
  gl::Uint marked = 0;   ///< bits that are set where a fragment is written
  bool isOff() const { return tested == 0 && marked == 0; }
  bool operator==(const Stencil& other) const {
    return tested == other.tested && required == other.required && marked == other.marked;
  }
};
inline constexpr Stencil kMarkServed{0, 0, Stencil::kServed}, kMarkChanged{0, 0, Stencil::kChanged},
    kMarkEdges{0, 0, Stencil::kEdge}, kOnlyUnserved{Stencil::kServed};
constexpr Stencil onEdges(const Stencil& s) {
  return {s.tested | Stencil::kEdge, s.required | Stencil::kEdge, s.marked};
}
constexpr Stencil offEdges(const Stencil& s) { return {s.tested | Stencil::kEdge, s.required, s.marked}; }

struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The rectangles that a draw is drawn in, one after the other: none takes longer than a limit.
struct Bands {
  Size size;               ///< of each; of what is left at the right and at the top less. 0, 0: there is one
  double milliseconds = 0; ///< that one may take
  double estimate = 0;     ///< the same before what was learned of it; 0: nothing is to be
};

/// From the lowest row on, each from left to right.
template <typename Function>
void forEachBand(const Viewport& all, const Size& size, Function&& function) {
  const int width = size.width > 0 ? size.width : all.width, height = size.height > 0 ? size.height : all.height;
  for (int y = 0; y < all.height; y += height)
    for (int x = 0; x < all.width; x += width)
      function(Viewport{all.x + x, all.y + y, std::min(width, all.width - x), std::min(height, all.height - y)});
}

/// Texels of the CPU's for a texture of our own.
struct Upload {
  gl::Uint texture = 0;
  int width = 0, height = 0;
  std::vector<glm::vec4> texels;
};

struct Clear {
  gl::Uint framebuffer = 0;
  gl::Uint stencil = 0; ///< these bits, to 0; none: the first colour, to:
  glm::vec4 colour{0};
};

/// Copies a rectangle of one framebuffer's first colour into another's, bit by bit where they have one format.
struct Copy {
  std::string title;
  gl::Uint from = 0, to = 0;
  Viewport source;
  int x = 0, y = 0; ///< of the target, from where on
};

/// A texture by the sampler that reads it.
struct NamedTexture {
  std::string sampler;
  gl::Uint texture = 0;
  bool mayLack = false; ///< its program asks a block whether there is one
};

struct Draw {
  std::string title;
  gl::Variant variant;
  std::vector<NamedTexture> reads;
  gl::Uint framebuffer = 0;
  Viewport viewport;
  Bands bands;
  Blend blend = Blend::Replace;
  Stencil stencil;
  Counting counting;
  int firstVertex = 0, vertices = 3, instances = 1;
  std::array<int, 3> blocks{}; ///< frame, light, epipolar (or copy, ambient): index of the block; 0: none
  // Once the program is built:
  gl::Uint program = 0;
  struct Reading {
    gl::Uint unit;
    gl::Enum target;
    gl::Uint texture;
  };
  std::vector<Reading> textures;

  int bandCount() const {
    const auto parts = [](int length, int part) { return part > 0 ? unitsFor(length, part) : 1; };
    return parts(viewport.width, bands.size.width) * parts(viewport.height, bands.size.height);
  }
  bool isWhole() const { return bandCount() == 1; }
};

/// A pass that is not drawn, and why.
struct Skip {
  std::string pass, why;
};

using Step = std::variant<Upload, Clear, Copy, Draw, Skip>;

inline constexpr std::size_t kLargestBlock =
    std::max({sizeof(blocks::FrameBlock), sizeof(blocks::LightBlock), sizeof(blocks::EpipolarBlock),
              sizeof(blocks::CopyBlock), sizeof(blocks::AmbientBlock)});

struct FramePlan {
  std::vector<Step> steps;
  /// Uniform blocks; the first stands for those that a draw does not read, since GL wants all of a program's bound.
  std::vector<std::vector<std::uint8_t>> blocks{std::vector<std::uint8_t>(kLargestBlock)};
  std::uint64_t marched = 0;   ///< rays that need no counting
  std::uint64_t slices = 0;    ///< likewise, that are drawn
  double bandMilliseconds = 0; ///< longest that a draw, or what GL gets at once, may take; 0: no limit

  void skip(std::string pass, std::string why) { steps.emplace_back(Skip{std::move(pass), std::move(why)}); }

  /// The block that add() gave that index for.
  template <typename Block>
  Block block(int index) const {
    Block value;
    std::memcpy(&value, blocks.at(static_cast<std::size_t>(index)).data(), sizeof value);
    return value;
  }

  /// Index of the block.
  template <typename Block>
  int add(const Block& block) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&block);
    blocks.emplace_back(bytes, bytes + sizeof block);
    return static_cast<int>(blocks.size()) - 1;
  }
};

} // namespace tyndall
