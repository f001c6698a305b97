// Gives back, or leaves empty, what the passes of an AVSM change beyond gl::StateGuard: storage buffers and an image
// unit (OpenGL 4.3).
#pragma once

#include "gl/Enums.h"
#include "gl/Functions.h"

#include <array>
#include <tyndall/tyndall.h>

namespace tyndall::avsm {

inline constexpr int kStorageBindings = 3; ///< storage buffer bindings 0..2 and image unit 0 are ours during resolve()

class StorageGuard {
public:
  StorageGuard(const gl::Functions& gl, StateMode mode);
  ~StorageGuard();
  StorageGuard(const StorageGuard&) = delete;
  StorageGuard& operator=(const StorageGuard&) = delete;

private:
  struct Binding {
    gl::Int buffer = 0;
    gl::Int64 start = 0, size = 0;
  };
  struct Image {
    gl::Int name = 0, level = 0, layered = 0, layer = 0, access = gl::READ_ONLY, format = gl::R32F;
  };

  void save();

  const gl::Functions& gl_;
  gl::Int buffer_ = 0;
  std::array<Binding, kStorageBindings> bindings_;
  Image image_;
};

/// The generic storage buffer binding only.
class BufferGuard {
public:
  BufferGuard(const gl::Functions& gl, StateMode mode);
  ~BufferGuard();
  BufferGuard(const BufferGuard&) = delete;
  BufferGuard& operator=(const BufferGuard&) = delete;

private:
  const gl::Functions& gl_;
  gl::Int buffer_ = 0;
};

} // namespace tyndall::avsm
