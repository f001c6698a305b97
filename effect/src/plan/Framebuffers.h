// Framebuffers by what is attached to them. Those of textures of our own are made and checked once and kept as long as
// the textures; those with a texture of the engine's have it attached anew in every frame, since its name may have come
// to stand for another texture.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tyndall {

/// A texture that is drawn into, or a layer of one.
struct Surface {
  gl::Uint texture = 0;
  int layer = -1; ///< of a GL_TEXTURE_2D_ARRAY; -1: a GL_TEXTURE_2D
};

struct Attachments {
  std::array<gl::Uint, 3> colours{};     ///< textures; 0: nothing is written to that output
  gl::Uint stencil = 0;                  ///< renderbuffer
  bool engines = false;                  ///< a texture of the engine's is among them
  std::array<int, 3> layers{-1, -1, -1}; ///< of the colours that are arrays
  bool operator==(const Attachments& other) const {
    return colours == other.colours && stencil == other.stencil && engines == other.engines && layers == other.layers;
  }
};

inline constexpr int kKeptFrames = 8; ///< that what was made for a frame is kept after its last use

class Framebuffers {
public:
  explicit Framebuffers(const gl::Functions& gl) : gl_(gl) {}

  /// 0 if GL calls it incomplete. Binds it.
  gl::Uint get(const Attachments& attachments);

  /// The engine's textures are to be attached anew; those not attached for kKeptFrames frames are let go.
  void beginFrame();

  /// One of our own is to be deleted.
  void forgetTexture(gl::Uint name);
  void forgetStencil(gl::Uint name);

private:
  struct Entry {
    Attachments attachments;
    gl::Framebuffer framebuffer;
    std::uint64_t frame = 0; // of its last use
  };
  bool attach(const Entry& entry) const;
  template <typename Condition>
  void drop(Condition&& condition);

  const gl::Functions& gl_;
  std::vector<Entry> entries_;
  std::uint64_t frame_ = 0;
};

} // namespace tyndall
