#include "InputChecks.h"

#include "SharedBlocks.h"
#include "gl/OwnErrors.h"
#include "gl/StateGuard.h"

#include <algorithm>
#include <cstdlib>

namespace tyndall {

namespace {

constexpr std::size_t kPoints = CHECK_WIDTH * CHECK_HEIGHT;
constexpr std::size_t kBytes = 2 * kPoints * kMaxLights;

InputCounts countsOf(const unsigned char* points) {
  std::array<int, 6> counts{};
  for (std::size_t i = 0; i < kPoints; ++i)
    ++counts[std::min<std::size_t>(points[i], counts.size() - 1)];
  return {counts[0], counts[1], counts[2], counts[3], counts[4], counts[5]};
}

} // namespace

std::vector<std::string> judge(const std::vector<LightChecks>& lights) {
  std::vector<std::string> warnings;
  for (const LightChecks& c : lights)
    if (std::getenv("TY_CHECK"))
      std::fprintf(stderr, "check %zu: surfaces n%d a%d h%d m%d e%d o%d  casters n%d a%d h%d m%d e%d o%d\n", c.light,
                   c.surfaces.nothing, c.surfaces.agree, c.surfaces.hidden, c.surfaces.missing, c.surfaces.empty,
                   c.surfaces.outside, c.casters.nothing, c.casters.agree, c.casters.hidden, c.casters.missing,
                   c.casters.empty, c.casters.outside);
  return warnings;
}

// ---------------------------------------------------------------------------------------------------------------------

InputChecks::~InputChecks() {
  for (const Batch& batch : batches_)
    if (batch.sync) gl_.DeleteSync(batch.sync);
}

InputChecks::Batch* InputChecks::freeBatch() {
  const auto free = std::find_if(batches_.begin(), batches_.end(), [](const Batch& b) { return !b.sync; });
  return free == batches_.end() ? nullptr : &*free;
}

Status InputChecks::reserve(StateMode state) {
  Batch* batch = freeBatch();
  if (!batch || batch->buffer) return {};
  const gl::PackGuard packing(gl_, state); // the target is its own
  gl::OwnErrors errors(gl_);
  batch->buffer = gl::Buffer(gl_);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, batch->buffer.name());
  gl_.BufferData(gl::PIXEL_PACK_BUFFER, kBytes, nullptr, gl::STREAM_READ);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, 0);
  if (errors.take() == gl::NO_ERROR) return {};
  batch->buffer = gl::Buffer();
  return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(kBytes) + " bytes to check inputs"};
}

void InputChecks::ask(gl::Uint texture, std::uint32_t lights, StateMode state) {
  Batch* batch = freeBatch();
  if (!batch) return;
  const gl::PackGuard packing(gl_, state);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, batch->buffer.name());
  gl_.ActiveTexture(gl::TEXTURE0);
  gl_.BindTexture(gl::TEXTURE_2D, texture);
  gl_.GetTexImage(gl::TEXTURE_2D, 0, gl::RED, gl::UNSIGNED_BYTE, nullptr);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, 0);
  batch->sync = gl_.FenceSync(gl::SYNC_GPU_COMMANDS_COMPLETE, 0);
  batch->lights = lights;
  batch->number = ++asked_;
}

void InputChecks::receive() {
  for (Batch& batch : batches_) {
    if (!batch.sync) continue;
    const gl::Enum state = gl_.ClientWaitSync(batch.sync, gl::SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state != gl::ALREADY_SIGNALED && state != gl::CONDITION_SATISFIED) continue;
    if (batch.number > known_) take(batch);
    gl_.DeleteSync(batch.sync);
    batch.sync = nullptr;
  }
}

// The GPU is done with it.
void InputChecks::take(const Batch& batch) {
  std::vector<unsigned char> points(kBytes);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, batch.buffer.name());
  gl_.GetBufferSubData(gl::UNIFORM_BUFFER, 0, kBytes, points.data());
  std::vector<LightChecks> lights;
  for (std::size_t i = 0; i < kMaxLights; ++i)
    if (batch.lights & (1U << i))
      lights.push_back({i, countsOf(&points[2 * i * kPoints]), countsOf(&points[(2 * i + 1) * kPoints])});
  warnings_ = judge(lights);
  known_ = batch.number;
}

std::uint64_t InputChecks::bytes() const {
  const auto held =
      std::count_if(batches_.begin(), batches_.end(), [](const Batch& b) { return static_cast<bool>(b.buffer); });
  return static_cast<std::uint64_t>(held) * kBytes;
}

} // namespace tyndall
