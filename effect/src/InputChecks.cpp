#include "InputChecks.h"

#include "SharedBlocks.h"
#include "gl/OwnErrors.h"
#include "gl/ReadBuffer.h"
#include "gl/StateGuard.h"
#include "optics/Blocks.h"

#include <algorithm>

namespace tyndall {

namespace {

constexpr std::size_t kPoints = CHECK_WIDTH * CHECK_HEIGHT;
constexpr std::size_t kChannels = 4; // as whatever has normalised texels is read in every context, OpenGL ES, too
constexpr std::size_t kBytes = kChannels * 2 * kPoints * kMaxLights;

void count(const unsigned char* point, InputCounts& counts) {
  const std::array<int*, 6> kinds = {&counts.nothing, &counts.agree, &counts.hidden,
                                     &counts.missing, &counts.empty, &counts.outside};
  ++*kinds[std::min<std::size_t>(point[0] & 7, kinds.size() - 1)];
  counts.quarter += point[0] >> 3 & 1;
  counts.atNear += point[0] >> 4 & 1;
  for (std::size_t i = 0; i < kHints; ++i)
    counts.hints[i] += point[1] >> i & 1;
}

LightChecks checksOf(const CheckedLight& light, const unsigned char* points) {
  LightChecks checks{light, {}, {}, std::vector<InputCounts>(light.views)};
  for (std::size_t i = 0; i < kPoints; ++i) {
    const unsigned char* surface = points + kChannels * i;
    count(surface, checks.surfaces);
    if (surface[2] < light.views) count(surface, checks.byView[surface[2]]);
    count(surface + kChannels * kPoints, checks.casters);
  }
  return checks;
}

// Right inputs have none of what is impossible, but for a few points at the edges of leaves.
constexpr int kFew = 16;               // points of a grid that mean nothing
constexpr double kMostWrong = 0.1;     // share of the impossible among what no other surface hides
constexpr double kMostWrongView = 0.3; // the same of one view
constexpr double kNearlyAll = 0.9;

std::string percent(int part, int all) { return std::to_string(100 * part / std::max(all, 1)) + " %"; }

std::string lineOf(const LightChecks& checks, const std::string& text) {
  return "Frame::lights[" + std::to_string(checks.light.index) + "].shadow: " + text;
}

// Fields that may be the cause.
std::string suspects(const CheckedLight& light) {
  std::string fields = light.isCube
                           ? "position, cube.nearDistance, cube.farDistance, the faces' order, their up vectors"
                           : "clipFromWorld";
  if (light.hasRectangles) fields += ", rectangle";
  fields += light.hasDistances ? ", encoding, scale" : light.isCube ? ", cube.reversedDepth" : ", clipDepth";
  return fields + " or the camera wrong? (DebugView::Inputs shows it" +
         (light.index > 0 ? " of the first light: put this one there)" : ")");
}

std::string mistake(Hint hint, const CheckedLight& light) {
  switch (hint) {
  case Hint::Biased:
    return "clipFromWorld is a matrix for texture coordinates, from 0 to 1; clip space runs from -1 to 1";
  case Hint::WholeLayer:
    return "clipFromWorld is a matrix into the whole layer; it must be the view's own, and rectangle says where that "
           "is";
  case Hint::FromTop:
    return "rectangle counts rows from the top; row 0 of a texture is the bottom row";
  case Hint::OtherView:
    return light.isCube ? "the cube's faces are in another order than GL's"
                        : "views are in another order than their layers or rectangles";
  default:
    return light.isCube ? "the cube's faces are upside down: GL has y downwards in them" : "the map is upside down";
  }
}

bool exceeds(const InputCounts& c, double share) {
  return c.impossible() > kFew && c.impossible() > share * (c.agree + c.impossible());
}

// The mistake that would bring most of what does not agree to do so, where hardly anything does or much cannot be. Some
// of it lies in shadow. Another view is the last to be thought of: of several, one may agree by chance.
std::string likelyMistake(const InputCounts& c, const CheckedLight& light) {
  const auto explains = [&](int hinted, double share) {
    return hinted >= 2 * kFew && hinted >= share * (c.compared() + c.outside - c.agree) &&
           (hinted >= 2 * c.agree || exceeds(c, kMostWrong));
  };
  constexpr auto kOther = static_cast<std::size_t>(Hint::OtherView);
  std::array<int, kHints> others = c.hints;
  others[kOther] = 0;
  const auto most = std::max_element(others.begin(), others.end());
  if (explains(*most, 0.25)) return mistake(static_cast<Hint>(most - others.begin()), light);
  return explains(c.hints[kOther], 0.6) ? mistake(Hint::OtherView, light) : "";
}

std::string likelyMistake(const LightChecks& checks) {
  std::string found = likelyMistake(checks.surfaces, checks.light);
  for (std::size_t i = 0; i < checks.byView.size() && found.empty(); ++i)
    found = likelyMistake(checks.byView[i], checks.light);
  return found.empty() ? found : "it would agree if " + found;
}

bool isImpossible(const LightChecks& checks) {
  return exceeds(checks.surfaces, kMostWrong) ||
         std::any_of(checks.byView.begin(), checks.byView.end(),
                     [](const InputCounts& c) { return exceeds(c, kMostWrongView); });
}

// ", all in views[1]": where it is so.
std::string placeOf(const LightChecks& checks) {
  const auto most = std::max_element(checks.byView.begin(), checks.byView.end(),
                                     [](const auto& a, const auto& b) { return a.impossible() < b.impossible(); });
  if (checks.byView.size() < 2 || most->impossible() < kNearlyAll * checks.surfaces.impossible()) return "";
  const auto view = static_cast<std::size_t>(most - checks.byView.begin());
  constexpr std::array<const char*, 6> kFaces = {"+x", "-x", "+y", "-y", "+z", "-z"};
  return checks.light.isCube ? std::string(", nearly all in face ") + kFaces[view]
                             : ", nearly all in views[" + std::to_string(view) + "]";
}

// The camera's surfaces, and where the light's map does not have them.
void judgeSurfaces(const LightChecks& checks, std::vector<std::string>& warnings) {
  const InputCounts& c = checks.surfaces;
  const std::string likely = likelyMistake(checks);
  if (checks.light.isHazy) return;
  if (!isImpossible(checks) && likely.empty()) return;
  if (c.impossible() <= kFew) {
    warnings.push_back(lineOf(checks, "hardly a surface that the camera shows is where its map has one: " + likely));
    return;
  }
  const bool empty = c.empty > c.missing;
  const std::string others = empty ? "cleared, not drawn yet, another light's, without what receives light, or "
                                   : "another frame's, only back faces, or ";
  warnings.push_back(lineOf(
      checks, percent(c.impossible(), c.agree + c.impossible()) + " of the surfaces that the camera shows lit are " +
                  (empty ? "where the map has none" : "far in front of the map's") + placeOf(checks) + ": " +
                  (likely.empty() ? others + suspects(checks.light) : likely)));
}

// The map's surfaces, and where the camera looks through them.
void judgeCasters(const LightChecks& checks, std::vector<std::string>& warnings) {
  const InputCounts& c = checks.casters;
  if (!exceeds(c, kMostWrong)) return;
  const std::string likely = likelyMistake(checks);
  const bool empty = c.empty > c.missing;
  const std::string others =
      empty ? "depth or map cleared or of another frame, or " : "other near and far planes than depth has, or ";
  warnings.push_back(lineOf(checks, std::to_string(c.impossible()) + " of " + std::to_string(c.agree + c.impossible()) +
                                        " points of the map that the camera should show are " +
                                        (empty ? "sky in the scene depth" : "far in front of the scene depth's") +
                                        ": " + (likely.empty() ? others + suspects(checks.light) : likely)));
}

// A map of nothing but the near plane was cleared to it, or is still to be drawn.
void judgeNear(const LightChecks& checks, std::vector<std::string>& warnings) {
  const InputCounts& c = checks.casters;
  if (c.atNear > kNearlyAll * (c.compared() + c.outside + c.atNear) && c.atNear > kFew)
    warnings.push_back(lineOf(checks, percent(c.atNear, c.compared() + c.outside + c.nothing) +
                                          " of the map is at its near plane or nearer: cleared to that, not drawn yet, "
                                          "reversed (clipFromWorld says whether it is), or in another encoding?"));
}

// Where nothing agrees the camera may look at what is in full shadow: but not at so much less than the distance of all
// casters.
void judgeHidden(const LightChecks& checks, std::vector<std::string>& warnings) {
  const InputCounts &s = checks.surfaces, &c = checks.casters;
  if (s.agree + c.agree > kFew || isImpossible(checks) || exceeds(c, kMostWrong)) return;
  if (c.hidden > 4 * kFew && c.quarter > kNearlyAll * c.hidden)
    warnings.push_back(lineOf(checks, "the scene depth is at less than a quarter of the distance of all that the map "
                                      "has there: other near and far planes than depth has?"));
}

void judgeViews(const LightChecks& checks, std::vector<std::string>& warnings) {
  const int visible = checks.surfaces.compared() + checks.surfaces.outside;
  if (checks.light.isSun && visible > 4 * kFew && checks.surfaces.compared() == 0)
    warnings.push_back(lineOf(checks, "no visible surface lies in its views: is a matrix wrong, or in other units?"));
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
    judgeNear(light, warnings);
    judgeViews(light, warnings);
    judgeSurfaces(light, warnings);
    judgeCasters(light, warnings);
    judgeHidden(light, warnings);
  }
  return warnings;
}

namespace {

CheckedLight checkedLight(const Frame& frame, std::size_t index) {
  const Light& light = frame.lights[index];
  const ShadowMap& shadow = light.shadow;
  CheckedLight checked{index};
  checked.isSun = light.kind == LightKind::Directional;
  checked.isHazy = light.curves.texture != 0;
  checked.isCube = shadow.cube.enabled;
  checked.hasRectangles = std::any_of(shadow.views.begin(), shadow.views.end(),
                                      [](const ShadowView& view) { return !optics::isWholeLayer(view.rectangle); });
  checked.hasDistances = shadow.encoding != DepthEncoding::Window;
  checked.views = checked.isCube ? 6 : shadow.views.size();
  return checked;
}

constexpr std::size_t kMostCameras = 8;

} // namespace

// ---------------------------------------------------------------------------------------------------------------------

InputChecks::Key::Key(const Frame& frame)
    : eye(frame.reuse.eye), viewport(frame.viewport),
      targets{frame.colour, frame.output.inscatter, frame.output.transmittance},
      layers{frame.colourLayer, frame.output.layer} {}

bool InputChecks::Key::operator==(const Key& other) const {
  const Rectangle &r = viewport, &s = other.viewport;
  return eye == other.eye && r.x == s.x && r.y == s.y && r.width == s.width && r.height == s.height &&
         targets == other.targets && layers == other.layers;
}

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

void InputChecks::ask(gl::Uint texture, const Frame& frame, const std::vector<std::size_t>& lights, StateMode state) {
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
  batch->frame = Key(frame);
  batch->lights.clear();
  for (const std::size_t light : lights)
    batch->lights.push_back(checkedLight(frame, light));
  batch->number = ++asked_;
}

InputChecks::Camera& InputChecks::cameraOf(const Key& frame) {
  const auto found = std::find_if(cameras_.begin(), cameras_.end(), [&](const Camera& c) { return c.frame == frame; });
  if (found != cameras_.end())
    std::rotate(found, found + 1, cameras_.end());
  else
    cameras_.push_back({frame});
  if (cameras_.size() > kMostCameras) cameras_.erase(cameras_.begin());
  return cameras_.back();
}

void InputChecks::forget(const Frame& frame) {
  Camera& camera = cameraOf(Key(frame));
  camera.known = asked_;
  camera.warnings.clear();
}

const std::vector<std::string>& InputChecks::warnings(const Frame& frame) const {
  static const std::vector<std::string> kNone;
  const Key key(frame);
  const auto found = std::find_if(cameras_.begin(), cameras_.end(), [&](const Camera& c) { return c.frame == key; });
  return found != cameras_.end() ? found->warnings : kNone;
}

void InputChecks::receive() {
  for (Batch& batch : batches_) {
    if (!batch.sync) continue;
    const gl::Enum state = gl_.ClientWaitSync(batch.sync, gl::SYNC_FLUSH_COMMANDS_BIT, 0);
    if (state != gl::ALREADY_SIGNALED && state != gl::CONDITION_SATISFIED) continue;
    take(batch);
    gl_.DeleteSync(batch.sync);
    batch.sync = nullptr;
  }
}

// The GPU is done with it.
void InputChecks::take(const Batch& batch) {
  Camera& camera = cameraOf(batch.frame);
  if (batch.number <= camera.known) return;
  std::vector<unsigned char> points(kBytes);
  gl_.BindBuffer(gl::UNIFORM_BUFFER, batch.buffer.name());
  gl::readBuffer(gl_, gl::UNIFORM_BUFFER, points.data(), points.size());
  std::vector<LightChecks> lights;
  lights.reserve(batch.lights.size());
  for (const CheckedLight& light : batch.lights)
    lights.push_back(checksOf(light, &points[kChannels * 2 * kPoints * light.index]));
  camera.warnings = judge(lights);
  camera.known = batch.number;
}

std::uint64_t InputChecks::bytes() const {
  const auto held =
      std::count_if(batches_.begin(), batches_.end(), [](const Batch& b) { return static_cast<bool>(b.buffer); });
  return static_cast<std::uint64_t>(held) * kBytes;
}

} // namespace tyndall
