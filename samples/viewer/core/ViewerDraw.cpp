// The viewer's pictures: fast while something moves, then whole, then measured.
#include "Viewer.h"

#include <chrono>
#include <cmath>
#include <gl/Gl.h>
#include <gl/Pause.h>
#include <gl/ReadBack.h>
#include <render/Outputs.h>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace viewer {

namespace {

constexpr double kRest = 0.15;      ///< seconds without a change after which nothing moves
constexpr double kStepShare = 0.35; ///< of the frame time, for a step of what takes long

double millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What the effect draws of settings: Difference is shown by the meter's picture, as it comes.
tyndall::Settings drawnSettings(tyndall::Settings settings) {
  if (settings.debugView == tyndall::DebugView::Difference) settings.debugView = tyndall::DebugView::Composite;
  return settings;
}

bool isRadiance(tyndall::DebugView view) {
  return view == tyndall::DebugView::Composite || view == tyndall::DebugView::Inscatter ||
         view == tyndall::DebugView::Difference;
}

bool isSame(const tyndall::Tuning& a, const tyndall::Tuning& b) {
  return a.reuse == b.reuse && a.fixup == b.fixup && a.compositing == b.compositing &&
         a.bandMilliseconds == b.bandMilliseconds;
}

} // namespace

bool Viewer::isPlaying() const { return (playback.isPlaying && duration_ > 0) || isOnPath(); }

bool Viewer::isMoving(double now) const { return isDirty_ || isPlaying() || now - lastChange_ < kRest; }

bool Viewer::isSettled() const { return drawn_ == Drawn::Full && !isDirty_; }

Viewer::Interruptible::Interruptible(Viewer& viewer) : viewer_(viewer) {
  viewer_.isInterruptible_ = true;
  viewer_.isAbandoned_ = false;
  viewer_.pauses_ = 0;
  viewer_.lastPause_ = std::chrono::steady_clock::now();
}

// Asked between draws. GL is waited for: what is not done yet cannot be given up, and takes a window's time all the
// same.
bool Viewer::goesOn() {
  constexpr double kPause = 40; // milliseconds between two
  if (!isInterruptible_) return true;
  host::gl().Finish();
  if (whileDrawing && millisecondsSince(lastPause_) > kPause) {
    const auto start = std::chrono::steady_clock::now();
    whileDrawing();
    pauses_ += millisecondsSince(start);
    lastPause_ = std::chrono::steady_clock::now();
  }
  return !isDirty_ && !isAbandoned_ && !isPlaying() && !loader_.isDone();
}

void Viewer::advance(double passed) {
  if (isOnPath()) followPath(passed);
  if (!playback.isPlaying || duration_ <= 0) return;
  const double seconds = playback.advanced(state().seconds, passed, duration_);
  if (seconds == state().seconds) return;
  setSeconds(seconds);
}

Activity Viewer::update(double now) {
  constexpr double kLongest = 0.25; // of what passes at once: a picture that took long makes no animation jump
  const double waited = now_ == 0 ? 0 : std::max(now - now_, 0.0), passed = std::min(waited, kLongest);
  now_ = now;
  if (std::optional<SceneLoader::Result> result = loader_.take()) takeScene(std::move(*result));
  if (!drawer_) return loader_.isLoading() ? Activity::Waiting : Activity::Idle;
  if (isRecording_) addToPath(waited);
  advance(passed);
  try {
    const Activity activity = proceed(now);
    if (isShown_) return activity;
    drawDisplay();
    return Activity::Drew;
  } catch (const host::Error& error) {
    say(error.what(), true);
    hasFailed_ = true;
    isDirty_ = false;
    meter_.stop();
    return Activity::Idle;
  }
}

Activity Viewer::proceed(double now) {
  const Activity rest = loader_.isLoading() || isRecording_ ? Activity::Waiting : Activity::Idle;
  if (hasFailed_) return rest;
  if (isMoving(now)) {
    if (!isDirty_) return Activity::Waiting;
    drawMoving();
    return Activity::Drew;
  }
  if (!isSettled()) {
    settle();
    return Activity::Drew;
  }
  if (!needsMeasuring()) return rest;
  measure();
  return Activity::Measured;
}

void Viewer::prepareTargets(const settings::State& state) {
  constexpr double kMostSamples = 36e6; // some 3 GiB, with all that is made of them
  const int width = renderedWidth(state), height = renderedHeight(state);
  const double samples = static_cast<double>(width) * height * state.msaa;
  if (samples > kMostSamples)
    throw host::Error("picture.supersample, msaa: " + std::to_string(width) + "x" + std::to_string(height) + " with " +
                      std::to_string(state.msaa) + " samples a pixel: the viewer draws at most 36 million samples");
  const bool isSized = surfaces_ && surfaces_->width() == width && surfaces_->height() == height;
  if (isSized && samples_ == state.msaa) return;
  samples_ = state.msaa;
  surfaces_ = std::make_unique<host::RenderTargets>(
      host::RenderTargetOptions{width, height, GL_RGBA32F, GL_DEPTH_COMPONENT32F, state.msaa});
  drawer_->forgetSurfaces();
}

void Viewer::drawScene(const settings::State& state, bool isCoarse) {
  const auto start = std::chrono::steady_clock::now();
  if (!isSame(tuning_, state.tuning)) {
    tuning_ = state.tuning;
    makeWays();
  }
  prepareTargets(state);
  settings::State drawn = state;
  drawn.reuse.changes = tyndall::Changes::Objects;
  const std::uint64_t number = frame_.reuse.frame + (std::exchange(isEdited_, false) ? 1 : 0);
  frame_.reuse = drawn.reuse;
  frame_.reuse.frame = number;
  frame_.medium = state.medium ? *state.medium : sceneMedium_;
  frame_.ambient = drawer_->ambientOf(state);
  render::Moment moment;
  moment.seconds = state.seconds;
  moment.isCoarse = isCoarse;
  host::Notes notes;
  drawer_->draw(drawn, moment, *surfaces_, frame_, notes);
  render::addOnce(notes_, notes);
  host::gl().Finish();
  sceneMilliseconds_ = millisecondsSince(start);
}

bool Viewer::drawWay(Way& way, const tyndall::Settings& settings) {
  const double before = pauses_;
  const bool isWhole = way.draw(*surfaces_, frame_, drawnSettings(settings));
  if (isWhole) way.leaveOut(pauses_ - before);
  return isWhole;
}

void Viewer::drawMoving() {
  const auto start = std::chrono::steady_clock::now();
  const settings::State fast = atLevel(state(), quality.level());
  pauses_ = 0;
  drawScene(fast, quality.level() > 0);
  drawWay(*first_, fast.settings);
  if (const std::optional<settings::Compared>& compared = state().compared) {
    settings::State other = state();
    other.settings = compared->settings;
    drawWay(*second_, atLevel(other, quality.level()).settings);
  }
  isDirty_ = false;
  drawn_ = Drawn::Moving;
  if (!exposure_) updateExposure();
  show();
  const double took = millisecondsSince(start);
  const bool hasCompiled = first_->hasCompiled() || (state().compared && second_->hasCompiled());
  if (!hasCompiled) quality.drew(took);
  frameTimes_.add(took, hasCompiled);
}

// Surfaces and maps are many draws, most of them short: GL is not waited for after each.
bool Viewer::drawWholeScene(const settings::State& state) {
  constexpr int kDraws = 12;      // in a row
  constexpr double kSeldom = 5.0; // milliseconds
  struct GivenUp {};
  int draws = 0;
  auto last = std::chrono::steady_clock::now();
  const host::Pause pause([&] {
    if (++draws < kDraws && millisecondsSince(last) < kSeldom) return;
    if (!goesOn()) throw GivenUp();
    draws = 0;
    last = std::chrono::steady_clock::now();
  });
  try {
    const double before = pauses_;
    drawScene(state, false);
    sceneMilliseconds_ -= pauses_ - before;
    return goesOn();
  } catch (const GivenUp&) {
    return false;
  }
}

// What is changed meanwhile is of the next picture, and gives this one up.
void Viewer::settle() {
  const Interruptible interruptible(*this);
  const settings::State full = state();
  isDirty_ = false;
  if (!drawWholeScene(full) || !drawWay(*first_, full.settings) || !goesOn()) return;
  if (full.compared && (!drawWay(*second_, full.compared->settings) || !goesOn())) return;
  drawn_ = Drawn::Full;
  updateExposure();
  show();
}

bool Viewer::needsMeasuring() const {
  if (meter_.isComplete()) return false;
  const bool isAsked = measuresErrors || state().settings.debugView == tyndall::DebugView::Difference;
  return isAsked && !frame_.lights.empty();
}

void Viewer::measure() {
  if (!meter_.isRunning()) {
    std::vector<const Way*> ways = {first_.get()};
    if (state().compared) ways.push_back(second_.get());
    meter_.begin(*surfaces_, ways);
    return;
  }
  meter_.step(kStepShare * quality.target());
  if (state().settings.debugView == tyndall::DebugView::Difference) show();
}

double Viewer::exposureStops() const {
  return state().exposureStops.value_or(std::log2(static_cast<double>(exposure_.value_or(1.0F))));
}

void Viewer::updateExposure() {
  if (state().exposureStops) return;
  render::Picture picture;
  picture.composite = host::readColour(first_->composite(), first_->width(), first_->height());
  exposure_ = render::exposureOf(picture);
}

void Viewer::drawDisplay() {
  isShown_ = true;
  if (first_->width() == 0) return;
  DisplayOptions options = options_;
  const tyndall::DebugView view = state().settings.debugView;
  options.exposure = static_cast<float>(std::exp2(exposureStops()));
  options.tone = state().tone;
  options.areNumbers = !isRadiance(view);
  options.exact = 0;
  if (view == tyndall::DebugView::Difference && !meter_.errors().empty() && meter_.share() > 0) {
    options.exact = meter_.exactInscatter();
    options.exactMean = static_cast<float>(std::max(meter_.errors().front().mean, 1e-30));
    options.exactRows = static_cast<float>(meter_.share());
  }
  const bool isCompared = state().compared.has_value();
  if (!isCompared) options.wipe = 1;
  const auto shownOf = [](const Way& way) {
    return Shown{way.composite(), way.inscatter(), way.width(), way.height()};
  };
  const Shown first = shownOf(*first_), second = isCompared && second_->width() > 0 ? shownOf(*second_) : first;
  if (isCompared && showsSecond_) options.wipe = 0;
  display_.draw(first, second, options, state().width, state().height);
}

void Viewer::setWipe(float share) {
  options_.wipe = share;
  show();
}

void Viewer::showSecond(bool shows) {
  if (showsSecond_ == shows) return;
  showsSecond_ = shows;
  show();
}

void Viewer::setDifferenceScale(float scale) {
  options_.differenceScale = scale;
  show();
}

Viewer::PixelValues Viewer::pixelAt(double x, double y) const {
  const Way& way = second() && (showsSecond_ || x >= options_.wipe) ? *second_ : *first_;
  PixelValues values;
  if (way.width() == 0) return values;
  values.x = std::clamp(static_cast<int>(x * way.width()), 0, way.width() - 1);
  values.y = std::clamp(static_cast<int>(y * way.height()), 0, way.height() - 1);
  const GladGLContext& gl = host::gl();
  float depth = 0;
  gl.BindFramebuffer(GL_FRAMEBUFFER, probe_.name());
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  for (const auto& [texture, rgb] :
       {std::pair{way.inscatter(), &values.inscatter}, std::pair{way.transmittance(), &values.transmittance}}) {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl.ReadPixels(values.x, values.y, 1, 1, GL_RGB, GL_FLOAT, rgb->data());
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, way.targets().framebuffer());
  gl.ReadPixels(values.x, values.y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  const double z = render::viewZ({depth}, way.frame().camera, state().reversedDepth).front();
  const LookAt view = this->view();
  const double aspect = static_cast<double>(state().width) / state().height;
  const double cosine = glm::dot(rayOf(view, aspect, {x, y}), glm::normalize(view.target - view.eye));
  values.distance = z >= render::kSkyZ ? tyndall::kInfinity : z / cosine;
  return values;
}

render::Picture Viewer::readPicture() const {
  render::Picture picture;
  const int width = first_->width(), height = first_->height();
  picture.composite = host::readColour(first_->composite(), width, height);
  picture.inscatter = host::readColour(first_->inscatter(), width, height);
  picture.transmittance = host::readColour(first_->transmittance(), width, height);
  picture.z =
      render::viewZ(host::readDepth(first_->targets().depth(), width, height), frame_.camera, state().reversedDepth);
  return picture;
}

void Viewer::savePicture(const std::filesystem::path& file) {
  try {
    if (!drawer_) throw host::Error("there is no picture to save: no scene is loaded");
    render::requirePictureName(file);
    requireOwnFile(file);
    const bool isOwnView = first_->width() > 0 && first_->frame().settings.debugView == state().settings.debugView;
    if (!isSettled() || !isOwnView) {
      drawScene(state(), false);
      first_->draw(*surfaces_, frame_, state().settings); // its difference, too, as the effect draws it
      updateExposure();
      changed();
    }
    render::Options options;
    static_cast<settings::State&>(options) = state();
    render::writePicture(file, readPicture(), options, static_cast<float>(std::exp2(exposureStops())));
    say("saved " + host::printable(file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
}

} // namespace viewer
