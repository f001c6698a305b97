// What a buffer holds, in every kind of context.
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <cstddef>
#include <cstring>

namespace tyndall::gl {

/// The first bytes of the buffer that is bound there. OpenGL ES has no glGetBufferSubData.
inline void readBuffer(const Functions& gl, Enum target, unsigned char* bytes, std::size_t count) {
  const auto size = static_cast<Sizeiptr>(count);
  if (gl.GetBufferSubData) return gl.GetBufferSubData(target, 0, size, bytes);
  const void* mapped = gl.MapBufferRange(target, 0, size, MAP_READ_BIT);
  if (!mapped) return;
  std::memcpy(bytes, mapped, count);
  gl.UnmapBuffer(target);
}

} // namespace tyndall::gl
