// The memory of captured segments (glsl/public/avsmCapture.glsl): a list for each texel of the map, whose first segment
// has a place of its own, and room for more that all lists share.
#pragma once

#include "gl/Objects.h"

#include <cstdint>
#include <tyndall/tyndall.h>

namespace tyndall::avsm {

inline constexpr std::uint32_t kMostSegments = 4096; ///< of a list: more would take a sort too long

/// As the shaders have it (std430).
struct ListsHeader {
  std::uint32_t room = 0, taken = 0, lost = 0, most = kMostSegments;
  std::int32_t width = 0, height = 0, layers = 0;
  std::uint32_t firsts = 0;

  std::uint64_t captured() const { return std::uint64_t{firsts} + (taken < room ? taken : room) + lost; }
};

class Lists {
public:
  Lists(const gl::Functions& gl, int size, int layers, std::uint64_t mostBytes);

  /// Empties the lists, with room for what was needed before. Binds buffers to the generic storage target.
  Status empty();
  /// Binds lists and segments to storage binding `first` and the next, and, if asked for, the links of exits to the one
  /// behind those.
  void bind(gl::Uint first, bool withExits) const;
  /// What was captured; waits for the GPU. Binds as empty() does.
  ListsHeader header() const;

  std::uint64_t bytes() const;
  std::uint32_t lists() const { return lists_; }

private:
  Status allocate(const gl::Buffer& buffer, std::uint64_t bytes) const;
  std::uint64_t roomIn(std::uint64_t bytes) const;

  const gl::Functions& gl_;
  ListsHeader empty_;
  std::uint32_t lists_;
  std::uint64_t mostBytes_;
  std::uint64_t room_ = 0; // of the buffers as they are
  gl::Buffer listBuffer_, segmentBuffer_, exitBuffer_;
  bool allocated_ = false;
};

} // namespace tyndall::avsm
