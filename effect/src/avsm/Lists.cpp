#include "avsm/Lists.h"

#include "gl/OwnErrors.h"

#include <algorithm>
#include <string>
#include <utility>

namespace tyndall::avsm {

namespace {

constexpr std::uint64_t kListBytes = 16, kSegmentBytes = 16;
constexpr std::uint64_t kFirstPerList = 8; // segments, until a frame has told

std::uint64_t listsOf(int size, int layers) {
  return static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(layers);
}

} // namespace

std::uint64_t leastBufferBytes(int size, int layers) {
  return sizeof(ListsHeader) + listsOf(size, layers) * std::max(kListBytes, kSegmentBytes);
}

Lists::Lists(const gl::Functions& gl, int size, int layers, std::uint64_t mostBytes, bool sortsExits)
    : gl_(gl), lists_(listsOf(size, layers)), mostBytes_(mostBytes), exitBytes_(sortsExits ? 4 : 0) {
  empty_.width = empty_.height = size;
  empty_.layers = layers;
  for (Reading& reading : readings_) {
    reading.buffer = gl::Buffer(gl);
    gl.BindBuffer(gl::SHADER_STORAGE_BUFFER, reading.buffer.name());
    gl.BufferData(gl::SHADER_STORAGE_BUFFER, sizeof(ListsHeader), nullptr, gl::STREAM_READ);
  }
}

Lists::~Lists() {
  for (Reading& reading : readings_)
    forget(reading);
}

// Segments beyond one for each list that memory, a storage buffer and 32 bits of an index allow.
std::uint64_t Lists::mostRoom() const {
  gl::Int limit = 0;
  gl_.GetIntegerv(gl::MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  const auto over = [&](std::uint64_t all) { return all > lists_ ? all - lists_ : 0; };
  const std::uint64_t least = lists_ * kListBytes;
  const std::uint64_t memory = mostBytes_ > least ? (mostBytes_ - least) / (kSegmentBytes + exitBytes_) : 0;
  const std::uint64_t block = static_cast<std::uint64_t>(limit > 0 ? limit : INT32_MAX) / kSegmentBytes;
  return std::min({over(memory), over(block), over(UINT32_MAX - lists_)});
}

std::uint64_t Lists::bytes() const {
  if (!allocated_) return 0;
  return sizeof(ListsHeader) + lists_ * kListBytes + (lists_ + room_) * (kSegmentBytes + exitBytes_);
}

Status Lists::allocate(gl::Buffer& buffer, std::uint64_t bytes) const {
  buffer = gl::Buffer(gl_);
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, buffer.name());
  gl::OwnErrors errors(gl_);
  gl_.BufferData(gl::SHADER_STORAGE_BUFFER, static_cast<gl::Sizeiptr>(bytes), nullptr, gl::DYNAMIC_COPY);
  if (errors.take() == gl::NO_ERROR) return {};
  return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(bytes) + " bytes for captured segments"};
}

Status Lists::makeRoom() {
  const std::uint64_t needed = allocated_ ? known_.taken : kFirstPerList * lists_;
  if (allocated_ && needed <= room_) return {};
  const std::uint64_t room = std::min(mostRoom(), needed + needed / 4);
  if (allocated_ && room <= room_) return {};
  gl::Buffer lists, segments, exits;
  if (!allocated_)
    if (Status s = allocate(lists, sizeof(ListsHeader) + lists_ * kListBytes); !s) return s;
  if (Status s = allocate(segments, (lists_ + room) * kSegmentBytes); !s) return s;
  if (exitBytes_ > 0)
    if (Status s = allocate(exits, (lists_ + room) * exitBytes_); !s) return s;
  if (!allocated_) listBuffer_ = std::move(lists);
  segmentBuffer_ = std::move(segments);
  exitBuffer_ = std::move(exits);
  room_ = room;
  allocated_ = true;
  return {};
}

void Lists::empty() const {
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, listBuffer_.name());
  ListsHeader header = empty_;
  header.room = static_cast<std::uint32_t>(room_);
  gl_.BufferSubData(gl::SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  // head, count, deepest, exits
  constexpr std::uint32_t kEmptyList[4] = {0xFFFFFFFFU, 0, 0xFFFFFFFFU, 0xFFFFFFFFU};
  gl_.ClearBufferSubData(gl::SHADER_STORAGE_BUFFER, gl::RGBA32UI, sizeof header,
                         static_cast<gl::Sizeiptr>(lists_ * kListBytes), gl::RGBA_INTEGER, gl::UNSIGNED_INT,
                         kEmptyList);
}

void Lists::bind(gl::Uint first, bool withExits, gl::Uint end) const {
  if (first < end) gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first, listBuffer_.name());
  if (first + 1 < end) gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first + 1, segmentBuffer_.name());
  if (withExits && exitBytes_ > 0) gl_.BindBufferBase(gl::SHADER_STORAGE_BUFFER, first + 2, exitBuffer_.name());
}

void Lists::send() {
  Reading& reading = readings_[++sent_ % readings_.size()];
  forget(reading); // where the GPU is that far behind, a newer one comes soon
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, listBuffer_.name());
  gl_.BindBuffer(gl::UNIFORM_BUFFER, reading.buffer.name());
  gl_.CopyBufferSubData(gl::SHADER_STORAGE_BUFFER, gl::UNIFORM_BUFFER, 0, 0, sizeof(ListsHeader));
  reading.sync = gl_.FenceSync(gl::SYNC_GPU_COMMANDS_COMPLETE, 0);
}

bool Lists::receive() {
  bool found = false;
  for (std::size_t age = 0; age < readings_.size(); ++age) {
    Reading& reading = readings_[(sent_ + readings_.size() - age) % readings_.size()];
    if (!reading.sync) continue;
    if (!found) {
      const gl::Enum state = gl_.ClientWaitSync(reading.sync, gl::SYNC_FLUSH_COMMANDS_BIT, 0);
      if (state != gl::ALREADY_SIGNALED && state != gl::CONDITION_SATISFIED) continue;
      known_ = read(reading);
      found = true;
    }
    forget(reading); // this one, and what is older
  }
  return found;
}

ListsHeader Lists::wait() const { return read(readings_[sent_ % readings_.size()]); }

ListsHeader Lists::read(const Reading& reading) const {
  ListsHeader header;
  gl_.BindBuffer(gl::SHADER_STORAGE_BUFFER, reading.buffer.name());
  gl_.GetBufferSubData(gl::SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  return header;
}

void Lists::forget(Reading& reading) const {
  if (reading.sync) gl_.DeleteSync(reading.sync);
  reading.sync = nullptr;
}

} // namespace tyndall::avsm
