#include "InputChecks.h"

#include "SharedBlocks.h"
#include "gl/OwnErrors.h"
#include "gl/ReadBuffer.h"
#include "gl/StateGuard.h"

#include <algorithm>

namespace tyndall {

namespace {

constexpr std::size_t kPoints = CHECK_WIDTH * CHECK_HEIGHT;
constexpr std::size_t kChannels = 4; // as whatever has normalised texels is read in every context, OpenGL ES, too
constexpr std::size_t kBytes = kChannels * 2 * kPoints * kMaxLights;

InputCounts countsOf(const unsigned char* points) {
  InputCounts counts;
  const std::array<int*, 6> kinds = {&counts.nothing, &counts.agree, &counts.hidden,
                                     &counts.missing, &counts.empty, &counts.outside};
  for (std::size_t i = 0; i < kPoints; ++i) {
    const unsigned char point = points[kChannels * i];
    ++*kinds[std::min<std::size_t>(point & 7, kinds.size() - 1)];
    counts.special += point >> 3 & 1;
    counts.atNear += point >> 4 & 1;
  }
  return counts;
}

// Right inputs have none of what is impossible, but for a few points at the edges of leaves.
constexpr int kFew = 16;           // points of a grid that mean nothing
constexpr double kMostWrong = 0.1; // share of the impossible among what no other surface hides
constexpr double kNearlyAll = 0.9;

constexpr const char* kMatrices = "camera, clipDepth or clipFromWorld wrong? (DebugView::Inputs shows it)";

std::string percent(int part, int all) { return std::to_string(100 * part / std::max(all, 1)) + " %"; }

std::string lineOf(const LightChecks& light, const std::string& text) {
  return "Frame::lights[" + std::to_string(light.light) + "].shadow: " + text;
}

bool isImpossible(const InputCounts& c) {
  return c.impossible() > kFew && c.impossible() > kMostWrong * (c.agree + c.impossible());
}

// The camera's surfaces, and where the light's map does not have them.
void judgeSurfaces(const LightChecks& light, std::vector<std::string>& warnings) {
  const InputCounts& c = light.surfaces;
  if (light.isHazy || !isImpossible(c)) return;
  const std::string share = percent(c.impossible(), c.agree + c.impossible());
  if (c.empty > c.missing)
    warnings.push_back(lineOf(light, share +
                                         " of the surfaces that the camera shows lit are where the map has none: "
                                         "cleared, not drawn yet, another light's, without what receives light, or " +
                                         kMatrices));
  else
    warnings.push_back(lineOf(light, share +
                                         " of the surfaces that the camera shows lit are far in front of the map's: "
                                         "another frame's, only back faces, or " +
                                         kMatrices));
}

// The map's surfaces, and where the camera looks through them.
void judgeCasters(const LightChecks& light, std::vector<std::string>& warnings) {
  const InputCounts& c = light.casters;
  if (!isImpossible(c)) return;
  const std::string share = percent(c.impossible(), c.agree + c.impossible());
  if (c.empty > c.missing)
    warnings.push_back(lineOf(light, share +
                                         " of the map's surfaces that the camera should show are sky in the scene "
                                         "depth: cleared, another frame's, or " +
                                         kMatrices));
  else
    warnings.push_back(lineOf(light, share +
                                         " of the map's surfaces that the camera should show are far in front of the "
                                         "scene depth's: other near and far planes than depth has, or " +
                                         kMatrices));
}

// Where nothing agrees the camera may look at what is in full shadow: but not at so much less than the distance of all
// casters, and not only in one corner of the views.
void judgeHidden(const LightChecks& light, std::vector<std::string>& warnings) {
  const InputCounts &s = light.surfaces, &c = light.casters;
  if (s.agree + c.agree > kFew || isImpossible(s) || isImpossible(c)) return;
  if (c.hidden > 4 * kFew && c.special > kNearlyAll * c.hidden)
    warnings.push_back(lineOf(light, "the scene depth is at less than a quarter of the distance of all that the map "
                                     "has there: other near and far planes than depth has?"));
  if (s.compared() > 4 * kFew && s.special > kNearlyAll * s.compared())
    warnings.push_back(lineOf(light, "all visible surfaces are in one quarter of its views, and none agrees: is the "
                                     "matrix one for texture coordinates, from 0 to 1?"));
}

void judgeViews(const LightChecks& light, std::vector<std::string>& warnings) {
  const int visible = light.surfaces.compared() + light.surfaces.outside;
  if (light.isSun && visible > 4 * kFew && light.surfaces.compared() == 0)
    warnings.push_back(lineOf(light, "no visible surface lies in its views: is a matrix wrong, or in other units?"));
}

void judgeDepth(const InputCounts& surfaces, std::vector<std::string>& warnings) {
  const int visible = surfaces.compared() + surfaces.outside;
  if (visible > 4 * kFew && surfaces.atNear > kNearlyAll * visible)
    warnings.push_back("Frame::depth: " + percent(surfaces.atNear, visible) +
                       " of the surfaces are at the near plane: is depth reversed, cleared, or of another projection?");
}

} // namespace

std::vector<std::string> judge(const std::vector<LightChecks>& lights) {
  std::vector<std::string> warnings;
  if (!lights.empty()) judgeDepth(lights.front().surfaces, warnings);
  for (const LightChecks& light : lights) {
    judgeViews(light, warnings);
    judgeSurfaces(light, warnings);
    judgeCasters(light, warnings);
    judgeHidden(light, warnings);
  }
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
  if (!reader_) reader_ = gl::Framebuffer(gl_);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, batch->buffer.name());
  gl_.BufferData(gl::PIXEL_PACK_BUFFER, kBytes, nullptr, gl::STREAM_READ);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, 0);
  if (errors.take() == gl::NO_ERROR) return {};
  batch->buffer = gl::Buffer();
  return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(kBytes) + " bytes to check inputs"};
}

void InputChecks::ask(gl::Uint texture, CheckedLights lights, StateMode state) {
  Batch* batch = freeBatch();
  if (!batch) return;
  const gl::PackGuard packing(gl_, state);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, batch->buffer.name());
  gl_.BindFramebuffer(gl::READ_FRAMEBUFFER, reader_.name());
  gl_.FramebufferTexture2D(gl::READ_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, texture, 0);
  gl_.ReadPixels(0, 0, CHECK_WIDTH, 2 * CHECK_HEIGHT * static_cast<gl::Sizei>(kMaxLights), gl::RGBA, gl::UNSIGNED_BYTE,
                 nullptr);
  gl_.BindBuffer(gl::PIXEL_PACK_BUFFER, 0);
  batch->sync = gl_.FenceSync(gl::SYNC_GPU_COMMANDS_COMPLETE, 0);
  batch->lights = lights;
  batch->number = ++asked_;
}

void InputChecks::forget() {
  known_ = asked_;
  warnings_.clear();
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
  gl::readBuffer(gl_, gl::UNIFORM_BUFFER, points.data(), points.size());
  std::vector<LightChecks> lights;
  for (std::size_t i = 0; i < kMaxLights; ++i)
    if (batch.lights.all >> i & 1U)
      lights.push_back({i, (batch.lights.suns >> i & 1U) != 0, (batch.lights.hazy >> i & 1U) != 0,
                        countsOf(&points[kChannels * 2 * i * kPoints]),
                        countsOf(&points[kChannels * (2 * i + 1) * kPoints])});
  warnings_ = judge(lights);
  known_ = batch.number;
}

std::uint64_t InputChecks::bytes() const {
  const auto held =
      std::count_if(batches_.begin(), batches_.end(), [](const Batch& b) { return static_cast<bool>(b.buffer); });
  return static_cast<std::uint64_t>(held) * kBytes;
}

} // namespace tyndall
