// The uniform blocks of a frame, one after the other in one buffer.
#pragma once

#include "gl/Objects.h"
#include "plan/FramePlan.h"

#include <array>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

class BlockBuffers {
public:
  explicit BlockBuffers(const gl::Functions& gl) : gl_(gl) {}

  /// Fills the next buffer with the plan's blocks, each where `alignment` (bytes) lets it begin. Binds it.
  Status upload(const FramePlan& plan, int alignment);

  /// Binds block `index` of the plan that was uploaded last.
  void bind(gl::Uint binding, int index) const;

  /// GL memory held, in bytes.
  std::uint64_t bytes() const { return buffers_.size() * capacity_; }

private:
  struct Part {
    std::size_t offset = 0, size = 0;
  };
  Status reserve(std::size_t size);

  const gl::Functions& gl_;
  std::array<gl::Buffer, 3> buffers_; // in turn, so that none is filled that the GPU reads
  std::size_t capacity_ = 0;          // of each
  std::size_t current_ = 0;
  std::vector<Part> parts_;
};

} // namespace tyndall
