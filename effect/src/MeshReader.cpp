#include "MeshReader.h"

#include "gl/OwnErrors.h"
#include "gl/ReadBuffer.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace tyndall {

namespace {

constexpr std::uint64_t kBatchBytes = std::uint64_t{4} << 20;
constexpr std::size_t kMostReadings = 1024;

std::uint64_t bytesOf(const MeshVertices& mesh, std::uint32_t count) {
  return std::uint64_t{mesh.stride} * (count - 1) + sizeof(glm::vec3);
}

Status invalid(const std::string& field, const std::string& rule) {
  return {StatusCode::InvalidFrame, "Frame::" + field + rule};
}

} // namespace

bool isSameMesh(const MeshVertices& a, const MeshVertices& b) {
  return a.buffer == b.buffer && a.offset == b.offset && a.stride == b.stride && a.count == b.count;
}

MeshReader::~MeshReader() {
  for (const Batch& batch : batches_)
    if (batch.sync) gl_.DeleteSync(batch.sync);
}

Status MeshReader::check(const std::string& field, const MeshVertices& mesh) const {
  const std::string buffer = field + "buffer is " + std::to_string(mesh.buffer) + ": ";
  if (!gl_.IsBuffer(mesh.buffer))
    return invalid(buffer, "not the name of a buffer in this context (deleted, or never bound?)");
  gl_.BindBuffer(gl::UNIFORM_BUFFER, mesh.buffer); // any target will do: this one is given back
  gl::Int mapped = 0, access = 0;
  gl_.GetBufferParameteriv(gl::UNIFORM_BUFFER, gl::BUFFER_MAPPED, &mapped);
  gl_.GetBufferParameteriv(gl::UNIFORM_BUFFER, gl::BUFFER_ACCESS_FLAGS, &access);
  if (mapped && !(static_cast<gl::Enum>(access) & gl::MAP_PERSISTENT_BIT)) return invalid(buffer, "it is mapped");
  gl::Int64 size = 0;
  gl_.GetBufferParameteri64v(gl::UNIFORM_BUFFER, gl::BUFFER_SIZE, &size);
  const std::uint64_t bytes = bytesOf(mesh, mesh.count);
  const auto held = static_cast<std::uint64_t>(size);
  if (mesh.offset > held || bytes > held - mesh.offset)
    return invalid(field + "count is " + std::to_string(mesh.count),
                   ": with offset " + std::to_string(mesh.offset) + " and stride " + std::to_string(mesh.stride) +
                       " the last vertex ends behind the buffer's " + std::to_string(held) + " bytes");
  return {};
}

MeshReader::Reading& MeshReader::readingOf(const MeshVertices& mesh) {
  const auto found = std::find_if(readings_.begin(), readings_.end(),
                                  [&](const Reading& r) { return isSameMesh(r.mesh.vertices, mesh); });
  if (found != readings_.end() && found->mesh.vertices.version == mesh.version) return *found;
  if (found != readings_.end()) readings_.erase(found);
  if (readings_.size() == kMostReadings) readings_.erase(readings_.begin());
  readings_.push_back({++count_, {mesh, {}}});
  return readings_.back();
}

// This frame's batch, or one that is free; none while the GPU has them all.
Status MeshReader::makeRoom(Batch*& batch) {
  const auto free = std::find_if(batches_.begin(), batches_.end(), [](const Batch& b) { return !b.sync; });
  batch = filling_ ? filling_ : free != batches_.end() ? &*free : nullptr;
  if (!batch || batch->buffer) return {};
  batch->buffer = gl::Buffer(gl_);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, batch->buffer.name());
  gl::OwnErrors errors(gl_);
  gl_.BufferData(gl::UNIFORM_BUFFER, kBatchBytes, nullptr, gl::STREAM_READ);
  if (errors.take() == gl::NO_ERROR) return {};
  batch->buffer = gl::Buffer();
  return {StatusCode::OutOfMemory,
          "GL could not allocate " + std::to_string(kBatchBytes) + " bytes to read meshes back"};
}

Status MeshReader::ask(const std::string& field, const MeshVertices& mesh) {
  Reading& reading = readingOf(mesh);
  if (reading.asked == mesh.count) return {};
  if (Status s = check(field, mesh); !s) return s;
  Batch* batch = nullptr;
  if (Status s = makeRoom(batch); !s) return s;
  const std::uint64_t room = batch ? kBatchBytes - batch->used : 0;
  if (room < sizeof(glm::vec3)) return {};
  const std::uint64_t fit = 1 + (room - sizeof(glm::vec3)) / mesh.stride;
  copy(*batch, reading, static_cast<std::uint32_t>(std::min<std::uint64_t>(fit, mesh.count - reading.asked)));
  filling_ = batch;
  return {};
}

void MeshReader::copy(Batch& batch, Reading& reading, std::uint32_t count) const {
  const MeshVertices& mesh = reading.mesh.vertices;
  const std::uint64_t from = mesh.offset + std::uint64_t{mesh.stride} * reading.asked;
  const std::uint64_t bytes = bytesOf(mesh, count);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, mesh.buffer);
  gl_.BindBuffer(gl::PIXEL_UNPACK_BUFFER, batch.buffer.name());
  gl_.CopyBufferSubData(gl::UNIFORM_BUFFER, gl::PIXEL_UNPACK_BUFFER, static_cast<gl::Intptr>(from),
                        static_cast<gl::Intptr>(batch.used), static_cast<gl::Sizeiptr>(bytes));
  gl_.BindBuffer(gl::PIXEL_UNPACK_BUFFER, 0);
  batch.pieces.push_back({reading.id, reading.asked, count, batch.used});
  batch.used += bytes;
  reading.asked += count;
}

void MeshReader::send() {
  if (filling_) filling_->sync = gl_.FenceSync(gl::SYNC_GPU_COMMANDS_COMPLETE, 0);
  filling_ = nullptr;
}

std::vector<MeshReader::Mesh> MeshReader::receive() {
  for (Batch& batch : batches_) {
    if (!batch.sync) continue;
    const gl::Enum state = gl_.ClientWaitSync(batch.sync, gl::SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state != gl::ALREADY_SIGNALED && state != gl::CONDITION_SATISFIED) continue;
    take(batch);
    gl_.DeleteSync(batch.sync);
    batch.sync = nullptr;
    batch.used = 0;
    batch.pieces.clear();
  }
  std::vector<Mesh> all;
  for (Reading& reading : readings_)
    if (reading.came == reading.mesh.vertices.count) all.push_back(std::move(reading.mesh));
  readings_.erase(std::remove_if(readings_.begin(), readings_.end(),
                                 [](const Reading& r) { return r.came == r.mesh.vertices.count; }),
                  readings_.end());
  return all;
}

// The GPU is done with it.
void MeshReader::take(const Batch& batch) {
  std::vector<unsigned char> data(batch.used);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, batch.buffer.name());
  gl::readBuffer(gl_, gl::UNIFORM_BUFFER, data.data(), data.size());
  for (const Piece& piece : batch.pieces) {
    const auto found =
        std::find_if(readings_.begin(), readings_.end(), [&](const Reading& r) { return r.id == piece.reading; });
    if (found == readings_.end()) continue; // forgotten meanwhile
    std::vector<glm::vec3>& points = found->mesh.points;
    points.resize(std::max<std::size_t>(points.size(), piece.first + piece.count));
    for (std::size_t i = 0; i < piece.count; ++i)
      std::memcpy(&points[piece.first + i], &data[piece.at + i * found->mesh.vertices.stride], sizeof(glm::vec3));
    found->came += piece.count;
  }
}

std::uint64_t MeshReader::bytes() const {
  const auto held =
      std::count_if(batches_.begin(), batches_.end(), [](const Batch& b) { return static_cast<bool>(b.buffer); });
  return static_cast<std::uint64_t>(held) * kBatchBytes;
}

} // namespace tyndall
