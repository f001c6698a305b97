#include "Viewer.h"

#include <algorithm>
#include <cmath>
#include <gl/Driver.h>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <settings/StateFile.h>

namespace viewer {

namespace {

constexpr std::uint64_t kMostMapBytes = 2ULL << 30;

void requireCamera(const settings::State& state, const render::SceneDrawer& drawer, const std::string& where) {
  if (state.camera && *state.camera >= static_cast<int>(host::cameraNodes(drawer.scene()).size()))
    throw host::Error(where + ": camera " + std::to_string(*state.camera) + " is not there");
}

/// How far in front of a camera its target is to be: as far as the scene's middle, if that is ahead.
double distanceToMiddle(const tyndall::Camera& camera, const host::Bounds& bounds) {
  const LookAt near = lookAtOf(camera, 1);
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  const double toMiddle = glm::dot(middle - near.eye, glm::normalize(near.target - near.eye));
  return std::max({toMiddle, 0.05 * glm::length(bounds.high - bounds.low), 1e-3});
}

} // namespace

Viewer::Viewer(const host::Context& context, tyndall::ProgramStore programs)
    : context_(context), programs_(std::move(programs)), meter_(configOf()), probe_(host::makeFramebuffer()) {
  makeWays();
}

Viewer::~Viewer() = default;

tyndall::Config Viewer::configOf() {
  tyndall::Config config;
  config.loader = context_.loader();
  config.timing = render::timingFor(context_);
  config.programs = programs_;
  config.tuning = tuning_;
  config.betweenDraws = [this] { return goesOn(); };
  // So short that a window lives on between them, however slow the processor: limits are of a slow GPU.
  constexpr double kBand = 0.5;
  if (host::isSoftware(context_.driver()) && tuning_.bandMilliseconds < 0) config.tuning.bandMilliseconds = kBand;
  return config;
}

void Viewer::makeWays() {
  first_ = std::make_unique<Way>(configOf());
  second_ = std::make_unique<Way>(configOf());
}

std::optional<Message> Viewer::takeMessage() {
  std::optional<Message> message = std::move(message_);
  message_.reset();
  return message;
}

void Viewer::changed() {
  lastChange_ = now_;
  isDirty_ = true;
  hasFailed_ = false;
  meter_.stop();
}

void Viewer::open(const std::filesystem::path& scene) {
  loadedState_.reset();
  loader_.start(scene);
}

void Viewer::openState(const std::filesystem::path& file) {
  try {
    settings::State state = settings::loadState(file);
    state.width = history_.state().width;
    state.height = history_.state().height;
    if (const std::string problem = problemIn(state); !problem.empty())
      throw host::Error(host::printable(file.string()) + ": " + problem);
    const bool isOfScene = scene() && state.scene.lexically_normal() == history_.state().scene.lexically_normal();
    if (!isOfScene && !state.scene.empty()) {
      loader_.start(state.scene);
      loadedState_ = state;
      return;
    }
    state.scene = history_.state().scene;
    if (drawer_) requireCamera(state, *drawer_, host::printable(file.string()));
    history_.endEdit();
    history_.edit("load " + host::printable(file.filename().string()), state);
    history_.endEdit();
    isEdited_ = true;
    changed();
    say("loaded " + host::printable(file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
}

void Viewer::requireOwnFile(const std::filesystem::path& file) const {
  if (!drawer_) return;
  const std::string identity = host::identityOf(file);
  for (const std::filesystem::path& read : drawer_->scene().files)
    if (host::identityOf(read) == identity)
      throw host::Error(host::printable(file.string()) + ": is a file of the scene");
}

void Viewer::saveState(const std::filesystem::path& file) {
  try {
    requireOwnFile(file);
    if (file.extension() != ".json")
      throw host::Error(host::printable(file.string()) + ": a state's name must end in .json");
    settings::saveState(file, history_.state());
    say("saved " + host::printable(file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
}

/// Of a scene without a camera.
LookAt Viewer::madeUpView(const render::SceneDrawer& drawer, const settings::State& state, host::Notes& notes) {
  const std::vector<glm::dmat4> pose = host::poseAt(drawer.scene(), state.seconds);
  const tyndall::Camera camera = render::SceneDrawer::cameraOf(drawer.scene(), state, pose, notes);
  return lookAtOf(camera, distanceToMiddle(camera, host::boundsOf(drawer.boxes(), pose)));
}

void Viewer::takeScene(SceneLoader::Result result) {
  if (!result.scene) {
    if (result.error != "cancelled") say(result.error, true);
    return;
  }
  try {
    settings::State state = loadedState_.value_or(history_.state());
    state.scene = result.file;
    if (!loadedState_) {
      state.camera.reset();
      state.lookAt.reset();
      state.lights.reset();
      state.medium.reset();
      state.ambient.reset();
      state.fog.reset();
      state.path.clear();
      state.seconds = 0;
    }
    host::Notes notes = result.scene->notes;
    auto drawer = std::make_unique<render::SceneDrawer>(std::move(*result.scene), context_, state, notes);
    requireCamera(state, *drawer, host::printable(result.file.string()));
    settings::State withoutMedium = state;
    withoutMedium.medium.reset();
    sceneMedium_ = drawer->mediumOf(withoutMedium, notes);
    if (!state.lookAt && !state.camera && host::cameraNodes(drawer->scene()).empty())
      state.lookAt = madeUpView(*drawer, state, notes);
    drawer_ = std::move(drawer);
    drawer_->mostMapBytes = kMostMapBytes;
    notes_ = notes;
    history_.reset(state);
    duration_ = durationOf(drawer_->scene());
    playback.isPlaying = isRecording_ = false;
    pathSeconds_ = -1;
    exposure_.reset();
    frameTimes_.clear();
    drawn_ = Drawn::Nothing;
    isEdited_ = true;
    changed();
    say("loaded " + host::printable(result.file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
  loadedState_.reset();
}

void Viewer::edit(const std::string& what, const settings::State& state) {
  if (const std::string problem = problemIn(state); !problem.empty()) return say(problem, true);
  history_.edit(what, state);
  isEdited_ = true;
  changed();
}

void Viewer::undo() {
  history_.undo();
  isEdited_ = true;
  changed();
}

void Viewer::redo() {
  history_.redo();
  isEdited_ = true;
  changed();
}

void Viewer::resize(int width, int height) {
  settings::State state = history_.state();
  const int most = tyndall::kMaxImageSize / state.supersample;
  const int newWidth = std::clamp(width, 1, most), newHeight = std::clamp(height, 1, most);
  if (newWidth == state.width && newHeight == state.height) return;
  state.width = newWidth;
  state.height = newHeight;
  history_.move(state);
  changed();
}

tyndall::Camera Viewer::sceneCamera(const std::vector<glm::dmat4>& pose) const {
  host::Notes ofNoConcern;
  try {
    return render::SceneDrawer::cameraOf(drawer_->boxes(), history_.state(), pose, ofNoConcern);
  } catch (const host::Error&) { // which is said when it is drawn
    return host::makeDefaultCamera(drawer_->boxes(), pose, 1, {}, ofNoConcern);
  }
}

LookAt Viewer::view() const {
  const settings::State& state = history_.state();
  if (state.lookAt || !drawer_) return state.lookAt.value_or(LookAt());
  const std::vector<glm::dmat4> pose = host::poseAt(drawer_->scene(), state.seconds);
  const tyndall::Camera camera = sceneCamera(pose);
  return lookAtOf(camera, distanceToMiddle(camera, host::boundsOf(drawer_->boxes(), pose)));
}

void Viewer::setView(const LookAt& view) {
  if (isOnPath()) pathSeconds_ = -1;
  settings::State state = history_.state();
  state.lookAt = view;
  state.camera.reset();
  if (!problemIn(state).empty()) return; // it has come too far
  history_.move(state);
  changed();
}

void Viewer::useSceneCamera(int index) {
  if (!drawer_ || index < 0 || index >= static_cast<int>(host::cameraNodes(drawer_->scene()).size())) return;
  if (isOnPath()) pathSeconds_ = -1;
  settings::State state = history_.state();
  state.lookAt.reset();
  state.camera = index;
  history_.move(state);
  changed();
}

void Viewer::frameAll() {
  if (!drawer_) return;
  const settings::State& state = history_.state();
  const host::Bounds bounds = host::boundsOf(drawer_->boxes(), host::poseAt(drawer_->scene(), state.seconds));
  setView(framed(view(), bounds, static_cast<double>(state.width) / state.height));
}

void Viewer::setSeconds(double seconds) {
  settings::State state = history_.state();
  if (state.seconds == seconds) return;
  state.seconds = seconds;
  history_.move(state);
  changed();
}

double Viewer::sceneSize() const {
  if (!drawer_) return 1;
  const host::Bounds bounds = host::boundsOf(drawer_->boxes(), host::poseAt(drawer_->scene(), 0));
  return std::max(glm::length(bounds.high - bounds.low), 1e-6);
}

void Viewer::record(bool records) {
  if (records == isRecording_ || !drawer_) return;
  isRecording_ = records;
  pathSeconds_ = records ? 0 : -1;
  if (records) {
    recorded_ = {{0, view()}};
    return;
  }
  settings::State state = history_.state();
  state.path = std::move(recorded_);
  edit("record path", state);
  endEdit();
}

void Viewer::playPath(bool plays) {
  record(false);
  pathSeconds_ = plays && !state().path.empty() ? 0 : -1;
}

void Viewer::addToPath(double passed) {
  pathSeconds_ += passed;
  addPoint(recorded_, pathSeconds_, view());
  if (recorded_.size() < settings::kMostPathPoints) return;
  record(false);
  say("the path is recorded: it may have no more than " + std::to_string(settings::kMostPathPoints) + " points");
}

void Viewer::followPath(double passed) {
  const std::vector<settings::PathPoint>& path = state().path;
  if (path.empty()) return playPath(false);
  const double end = path.back().seconds;
  double seconds = pathSeconds_ + passed * playback.speed;
  const bool isOver = seconds > end;
  if (isOver) seconds = playback.loops && end > 0 ? std::fmod(seconds, end) : end;
  setView(viewAt(path, seconds));
  pathSeconds_ = isOver && !playback.loops ? -1 : seconds;
}

} // namespace viewer
