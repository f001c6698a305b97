#include "Targets.h"

#include "gl/Program.h"

#include <algorithm>
#include <utility>

namespace tyndall {

struct TargetFormat {
  gl::Enum internal;
  gl::Enum channels;
  int bytes;
};

namespace {

using Format = TargetFormat;

constexpr Format kR32{gl::R32F, gl::RED, 4}, kRg32{gl::RG32F, gl::RG, 8}, kRgba32{gl::RGBA32F, gl::RGBA, 16},
    kRgba16{gl::RGBA16F, gl::RGBA, 8}, kUnorm2{gl::RG16, gl::RG, 4}, kUnorm4{gl::RGBA16, gl::RGBA, 8};

struct Row {
  const char* name;
  Format wide;   // three channels of radiance, or float depths
  Format narrow; // one channel, or 16-bit depths
  const char* size;
  const char* reason;
};

constexpr Row kRows[] = {
    {"inscatter", kRgba32, kRgba32, "image", "where the engine wants its own transmittance and a composite"},
    {"transmittance", kRgba32, kRgba32, "image", "where the engine wants its own inscatter and a composite"},
    {"slice table", kRgba32, kRgba32, "slices x (2 + 2 views)", "the slices' geometry, computed in double"},
    {"sample ends", kR32, kR32, "slices x samples", "distance along the camera ray; float, for breaks and the march"},
    {"marks", kUnorm4, kUnorm4, "slices x samples / 64", "four masks of 16 samples"},
    {"refined marks", kUnorm4, kUnorm4, "slices x samples / 64", "the marks with those of the refinement"},
    {"marched", kRgba16, kR32, "slices x (samples / 16 + 1)",
     "light of the regular march samples, in no unit (lib/stored.glsl)"},
    {"slice sums", kRg32, kRg32, "slices x 1", "inscatter over each slice, to be averaged"},
    {"mean light", kR32, kR32, "1 x 1", "the picture's mean inscatter"},
    {"extra offsets", kR32, kR32, "slices x (samples / 64 + 1)", "where a chunk's extra samples are packed"},
    {"extra", kRgba16, kRgba32, "slices x samples / 4", "the same of the march samples between, packed; red or grey"},
    {"extra green", kRgba16, kRgba16, "slices x samples / 4", "the same in green"},
    {"extra blue", kRgba16, kRgba16, "slices x samples / 4", "the same in blue"},
    {"epipolar inscatter", kRgba16, kRg32, "slices x samples", "the same of all samples, with their distance"},
    {"row depths", kRgba32, kUnorm4, "texels / 4 x rows", "the shadow map along each slice"},
    {"row shares", kUnorm4, kUnorm2, "texels / 4 x rows", "how much is lit behind a group's split; filtered or glass"},
    {"row nodes", kRgba32, kUnorm4, "texels / 16 x rows", "the tree's finest level, to gather the others from"},
    {"row node means", kUnorm4, kUnorm2, "texels / 16 x rows", "the same: averages; with glass, means"},
    {"row node moments", kUnorm4, kUnorm4, "texels / 16 x rows", "the same with glass: first moments"},
    {"row tree", kRgba32, kUnorm4, "nodes x rows", "all levels of the tree: where depths split"},
    {"row means", kUnorm4, kUnorm2, "nodes x rows", "the same: averages; with glass, means"},
    {"row moments", kUnorm4, kUnorm4, "nodes x rows", "the same with glass: first moments"},
    {"pair tree", kRg32, kUnorm2, "nodes x rows", "the same over two neighbouring rows, for rays between them"},
    {"curve cells", kRgba32, kRgba32, "cells x rows", "smoke and hair along each slice"},
    {"curve tree", kRgba32, kRgba32, "nodes x rows", "a tree over them"},
    {"low rank rays", kRgba32, kRgba32, "64 x terms", "low rank: factors of camera rays"},
    {"low rank lights", kRgba32, kRgba32, "1 or slices x 128 terms", "the same of light rays, and their prefix sums"},
    {"tint red", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "low rank with glass: terms times tints"},
    {"tint green", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "the same in green"},
    {"tint blue", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "the same in blue"},
    {"tint sums red", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "their prefix sums along each row"},
    {"tint sums green", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "the same in green"},
    {"tint sums blue", kRgba32, kRgba32, "texels / 4, 16, ... x rows terms / 4", "the same in blue"},
    {"row hashes", kRg32, kRg32, "texels / 4 x rows",
     "temporal reuse: all that decides along a row; filtered or glass"},
    {"changed parts", kRg32, kRg32, "texels / 256 x rows",
     "the same: depths between which a row differs from the last frame's"},
    {"changed ends", kR32, kR32, "slices x samples / 16", "the same: segments with other ends than in the last frame"},
    {"changed segments", kR32, kR32, "slices x samples / 16", "the same: those to be drawn anew"},
    {"changed slices", kRgba32, kRgba32, "slices x 1", "the same: from which segment to which, of eight slices"},
    {"moved slices", kRgba32, kRgba32, "slices x 1", "the same: those to be compared"},
    {"changed tiles", kR32, kR32, "256 x tiles / 256", "the same: squares of pixels to be drawn anew"},
    {"last depth", kR32, kR32, "image", "the same: the last frame's scene depth, where it is compared"},
    {"view", kRgba32, kRgba32, "image", "debug views of slices: what is counted or shown, until all lights are done"},
    {"view exact", kRgba32, kRgba32, "image", "debug view of the difference: exact's inscatter"},
    {"view row means", kR32, kR32, "image height x 1", "the same, or visits: mean over each row of pixels"},
    {"view mean", kR32, kR32, "1 x 1", "the same: their mean"},
};

} // namespace

gl::Uint Targets::get(Target target, int width, int height, bool wide) {
  const auto index = static_cast<std::size_t>(target);
  const Format& format = wide ? kRows[index].wide : kRows[index].narrow;
  for (Slot& slot : slots_[index])
    if (slot.width == width && slot.height == height && slot.format == format.internal) {
      slot.used = true;
      return slot.texture.name();
    }
  Slot slot = make(format, width, height);
  if (!slot.texture) { // without what this frame has not asked for it may fit
    dropUnused();
    slot = make(format, width, height);
  }
  if (!slot.texture) return 0;
  slots_[index].push_back(std::move(slot));
  return slots_[index].back().texture.name();
}

Targets::Slot Targets::make(const TargetFormat& format, int width, int height) {
  Slot slot{gl::Texture(gl_), true, width, height, format.bytes, format.internal};
  gl_.ActiveTexture(gl::TEXTURE0 + static_cast<gl::Enum>(gl::Unit::Upload));
  gl_.BindTexture(gl::TEXTURE_2D, slot.texture.name());
  gl_.TexParameteri(gl::TEXTURE_2D, gl::TEXTURE_MAX_LEVEL, 0);
  gl_.TexImage2D(gl::TEXTURE_2D, 0, static_cast<gl::Int>(format.internal), width, height, 0, format.channels, gl::FLOAT,
                 nullptr);
  if (gl_.GetError() == gl::OUT_OF_MEMORY) slot.texture = gl::Texture();
  return slot;
}

void Targets::dropUnused() {
  for (std::vector<Slot>& slots : slots_)
    slots.erase(std::remove_if(slots.begin(), slots.end(), [](const Slot& slot) { return !slot.used; }), slots.end());
}

void Targets::endFrame() {
  dropUnused();
  for (std::vector<Slot>& slots : slots_)
    for (Slot& slot : slots)
      slot.used = false;
}

void Targets::hold() {
  for (std::vector<Slot>& slots : slots_)
    for (Slot& slot : slots)
      slot.used = true;
}

gl::Uint Targets::stencil(int width, int height) {
  if (stencil_ && stencilWidth_ == width && stencilHeight_ == height) return stencil_.name();
  stencil_ = gl::Renderbuffer(gl_);
  stencilWidth_ = width;
  stencilHeight_ = height;
  gl_.BindRenderbuffer(gl::RENDERBUFFER, stencil_.name());
  gl_.RenderbufferStorage(gl::RENDERBUFFER, gl::STENCIL_INDEX8, width, height);
  if (gl_.GetError() == gl::OUT_OF_MEMORY) stencil_ = gl::Renderbuffer();
  return stencil_.name();
}

std::uint64_t Targets::bytes() const {
  const auto area = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  std::uint64_t sum = stencil_ ? area(stencilWidth_, stencilHeight_) : 0;
  for (const std::vector<Slot>& slots : slots_)
    for (const Slot& slot : slots)
      sum += area(slot.width, slot.height) * static_cast<std::uint64_t>(slot.bytesPerTexel);
  return sum;
}

} // namespace tyndall
