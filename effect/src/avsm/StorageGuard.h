// Gives back what the passes of an AVSM change beyond gl::StateGuard: storage buffers and an image unit (OpenGL 4.3).
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <array>

namespace tyndall::avsm {

inline constexpr int kStorageBindings = 3; ///< storage buffer bindings 0..2 and image unit 0 are ours during resolve()

class StorageGuard {
public:
  explicit StorageGuard(const gl::Functions& gl);
  ~StorageGuard();
  StorageGuard(const StorageGuard&) = delete;
  StorageGuard& operator=(const StorageGuard&) = delete;

private:
  struct Binding {
    gl::Int buffer = 0;
    gl::Int64 start = 0, size = 0;
  };
  struct Image {
    gl::Int name = 0, level = 0, layered = 0, layer = 0, access = 0, format = 0;
  };

  const gl::Functions& gl_;
  gl::Int buffer_ = 0;
  std::array<Binding, kStorageBindings> bindings_;
  Image image_;
};

/// Gives back the generic storage buffer binding only.
class BufferGuard {
public:
  explicit BufferGuard(const gl::Functions& gl);
  ~BufferGuard();
  BufferGuard(const BufferGuard&) = delete;
  BufferGuard& operator=(const BufferGuard&) = delete;

private:
  const gl::Functions& gl_;
  gl::Int buffer_ = 0;
};

} // namespace tyndall::avsm
