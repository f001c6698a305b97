// The effect's own textures: one table of name, format, size and reason. Allocated when a pass first needs them, again
// when the size changes.
#pragma once

#include "gl/Objects.h"

#include <array>
#include <cstdint>

namespace tyndall {

enum class Target { Inscatter, Transmittance, Count };

class Targets {
public:
  explicit Targets(const gl::Functions& gl) : gl_(gl) {}

  /// The texture at the size of the image; 0 if GL is out of memory.
  gl::Uint get(Target target, int width, int height);

  /// GL memory held, in bytes.
  std::uint64_t bytes() const;

private:
  struct Slot {
    gl::Texture texture;
    int width = 0;
    int height = 0;
  };
  const gl::Functions& gl_;
  std::array<Slot, static_cast<std::size_t>(Target::Count)> slots_;
};

} // namespace tyndall
