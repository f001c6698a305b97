// The memory of captured segments (glsl/public/avsmCapture.glsl): a list for each texel of the map, whose first segment
// has a place of its own, and room for more that all lists share.
#pragma once

#include "gl/Objects.h"

#include <array>
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
  Lists(const gl::Functions& gl, int size, int layers, std::uint64_t mostBytes, bool sortsExits);
  ~Lists();
  Lists(const Lists&) = delete;
  Lists& operator=(const Lists&) = delete;

  /// Makes room for what the newest frame that is known needed; if GL has none, the lists are as they were. Binds
  /// buffers to the generic storage target, as all others do.
  Status makeRoom();
  /// Empties the lists, once there is room.
  void empty() const;
  /// Binds lists and segments to storage binding `first` and the next, and, if asked for, the links of exits to the one
  /// behind those; no binding from `end` on.
  void bind(gl::Uint first, bool withExits, gl::Uint end = UINT32_MAX) const;

  /// Has the header of this frame sent back. Binds buffers to the generic storage and uniform targets.
  void send();
  /// Looks, without waiting, for a header that has come back; true if there is a newer one.
  bool receive();
  /// Waits for the header sent last.
  ListsHeader wait() const;
  /// The newest that receive() found.
  const ListsHeader& known() const { return known_; }

  std::uint64_t bytes() const;

private:
  struct Reading {
    gl::Buffer buffer;
    gl::Sync sync = nullptr; // null if there is nothing to come
  };

  Status allocate(gl::Buffer& buffer, std::uint64_t bytes) const;
  std::uint64_t mostRoom() const;
  ListsHeader read(const Reading& reading) const;
  void forget(Reading& reading) const;

  const gl::Functions& gl_;
  ListsHeader empty_;
  std::uint64_t lists_;
  std::uint64_t mostBytes_, exitBytes_; // of a segment, where exits are sorted, too
  std::uint64_t room_ = 0;              // of the buffers as they are
  gl::Buffer listBuffer_, segmentBuffer_, exitBuffer_;
  bool allocated_ = false;
  ListsHeader known_;
  std::array<Reading, 3> readings_; // of the last frames: as many as an engine has under way
  std::size_t sent_ = 0;
};

/// Bytes of the largest storage buffer that lists of this size need at least.
std::uint64_t leastBufferBytes(int size, int layers);

} // namespace tyndall::avsm
