#include "plan/BlockBuffers.h"

#include "gl/OwnErrors.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace tyndall {

Status BlockBuffers::upload(const FramePlan& plan, int alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  std::size_t size = 0;
  parts_.clear();
  for (const std::vector<std::uint8_t>& block : plan.blocks) {
    parts_.push_back({size, block.size()});
    size += (block.size() + unit - 1) / unit * unit;
  }
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    std::memcpy(bytes.data() + parts_[i].offset, plan.blocks[i].data(), parts_[i].size);
  if (Status s = reserve(size); !s) return s;
  current_ = (current_ + 1) % buffers_.size();
  gl_.BindBuffer(gl::UNIFORM_BUFFER, buffers_[current_].name());
  gl_.BufferSubData(gl::UNIFORM_BUFFER, 0, static_cast<gl::Sizeiptr>(size), bytes.data());
  return {};
}

// By powers of two, so that a few draws more need no other.
Status BlockBuffers::reserve(std::size_t size) {
  if (size <= capacity_) return {};
  std::size_t capacity = 16384;
  while (capacity < size)
    capacity *= 2;
  capacity_ = 0;
  gl::OwnErrors errors(gl_);
  for (gl::Buffer& buffer : buffers_) {
    if (!buffer) buffer = gl::Buffer(gl_);
    gl_.BindBuffer(gl::UNIFORM_BUFFER, buffer.name());
    gl_.BufferData(gl::UNIFORM_BUFFER, static_cast<gl::Sizeiptr>(capacity), nullptr, gl::DYNAMIC_DRAW);
  }
  if (errors.take() != gl::NO_ERROR)
    return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(capacity) + " bytes of uniform blocks"};
  capacity_ = capacity;
  return {};
}

void BlockBuffers::bind(gl::Uint binding, int index) const {
  const Part& part = parts_[static_cast<std::size_t>(index)];
  gl_.BindBufferRange(gl::UNIFORM_BUFFER, binding, buffers_[current_].name(), static_cast<gl::Intptr>(part.offset),
                      static_cast<gl::Sizeiptr>(part.size));
}

} // namespace tyndall
