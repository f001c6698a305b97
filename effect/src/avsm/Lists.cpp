#include "avsm/Lists.h"

#include <algorithm>
#include <string>

namespace tyndall::avsm {

namespace {

constexpr std::uint64_t kListBytes = 16, kSegmentBytes = 16, kExitBytes = 4;
constexpr std::uint64_t kFirstPerList = 8; // segments, until a frame has told

} // namespace

Lists::Lists(const gl::Functions& gl, int size, int layers, std::uint64_t mostBytes)
    : gl_(gl), lists_(static_cast<std::uint32_t>(size) * static_cast<std::uint32_t>(size * layers)),
      mostBytes_(mostBytes), listBuffer_(gl), segmentBuffer_(gl), exitBuffer_(gl) {
  empty_.width = empty_.height = size;
  empty_.layers = layers;
}

std::uint64_t Lists::roomIn(std::uint64_t bytes) const {
  const std::uint64_t least = lists_ * (kListBytes + kSegmentBytes + kExitBytes);
  return bytes > least ? (bytes - least) / (kSegmentBytes + kExitBytes) : 0;
}

std::uint64_t Lists::bytes() const {
  return sizeof(ListsHeader) + lists_ * kListBytes + (lists_ + room_) * (kSegmentBytes + kExitBytes);
}

Status Lists::allocate(const gl::Buffer& buffer, std::uint64_t bytes) const {
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, buffer.name());
  while (gl_.GetError() != gl::NO_ERROR) {
  }
  gl_.BufferData(gl::SHADER_STORAGE_BUFFER, static_cast<gl::Sizeiptr>(bytes), nullptr, gl::DYNAMIC_COPY);
  if (gl_.GetError() == gl::NO_ERROR) return {};
  return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(bytes) + " bytes for captured segments"};
}

Status Lists::empty() {
  gl::Int64 block = 0;
  gl::Int limit = 0;
  gl_.GetIntegerv(gl::MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  block = limit > 0 ? limit : INT32_MAX;
  const std::uint64_t blockSegments = static_cast<std::uint64_t>(block) / kSegmentBytes;
  if (blockSegments < lists_)
    return {StatusCode::OutOfMemory, "this context's storage blocks hold " + std::to_string(blockSegments) +
                                         " segments, fewer than the map's " + std::to_string(lists_) + " texels"};
  const std::uint64_t most =
      std::min({roomIn(mostBytes_), blockSegments - lists_, std::uint64_t{UINT32_MAX} - 2 * lists_});
  const std::uint64_t needed = allocated_ ? header().taken : kFirstPerList * lists_;
  const std::uint64_t room = std::min(most, needed > room_ ? needed + needed / 4 : room_);
  if (!allocated_) {
    if (Status s = allocate(listBuffer_, sizeof(ListsHeader) + lists_ * kListBytes); !s) return s;
  }
  if (!allocated_ || room > room_) {
    allocated_ = false;
    room_ = 0;
    if (Status s = allocate(segmentBuffer_, (lists_ + room) * kSegmentBytes); !s) return s;
    if (Status s = allocate(exitBuffer_, (lists_ + room) * kExitBytes); !s) return s;
    room_ = room;
    allocated_ = true;
  }
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, listBuffer_.name());
  ListsHeader header = empty_;
  header.room = static_cast<std::uint32_t>(room_);
  gl_.BufferSubData(gl::SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  // head, count, lock, exits
  constexpr std::uint32_t kEmptyList[4] = {0xFFFFFFFFU, 0, 0, 0xFFFFFFFFU};
  gl_.ClearBufferSubData(gl::SHADER_STORAGE_BUFFER, gl::RGBA32UI, sizeof header,
                         static_cast<gl::Sizeiptr>(lists_ * kListBytes), gl::RGBA_INTEGER, gl::UNSIGNED_INT,
                         kEmptyList);
  return {};
}

void Lists::bind(gl::Uint first, bool withExits) const {
  gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first, listBuffer_.name());
  gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first + 1, segmentBuffer_.name());
  if (withExits) gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first + 2, exitBuffer_.name());
}

ListsHeader Lists::header() const {
  ListsHeader header;
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, listBuffer_.name());
  gl_.GetBufferSubData(gl::SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  return header;
}

} // namespace tyndall::avsm
