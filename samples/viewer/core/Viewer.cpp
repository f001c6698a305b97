#include "Viewer.h"

#include <algorithm>
#include <cmath>
#include <scene/Error.h>
#include <scene/FileIo.h>
#include <settings/StateFile.h>

namespace viewer {

Viewer::Viewer(const host::Context& context, tyndall::ProgramStore programs)
    : context_(context), programs_(std::move(programs)), meter_(configOf()), probe_(host::makeFramebuffer()) {
  makeWays();
}

Viewer::~Viewer() = default;

tyndall::Config Viewer::configOf() const {
  tyndall::Config config;
  config.loader = context_.loader();
  config.timing = render::timingFor(context_);
  config.programs = programs_;
  config.tuning = tuning_;
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
    const bool isOfScene = scene() && state.scene.lexically_normal() == history_.state().scene.lexically_normal();
    if (!isOfScene && !state.scene.empty()) {
      loader_.start(state.scene);
      loadedState_ = state;
      return;
    }
    state.scene = history_.state().scene;
    history_.endEdit();
    history_.edit("load " + host::printable(file.filename().string()), state);
    history_.endEdit();
    changed();
    say("loaded " + host::printable(file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
}

void Viewer::saveState(const std::filesystem::path& file) {
  try {
    settings::saveState(file, history_.state());
    say("saved " + host::printable(file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
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
      state.seconds = 0;
    }
    host::Notes notes = result.scene->notes;
    auto drawer = std::make_unique<render::SceneDrawer>(std::move(*result.scene), context_, state, notes);
    if (state.camera && *state.camera >= static_cast<int>(host::cameraNodes(drawer->scene()).size()))
      throw host::Error(host::printable(result.file.string()) + ": camera " + std::to_string(*state.camera) +
                        " is not there");
    settings::State withoutMedium = state;
    withoutMedium.medium.reset();
    sceneMedium_ = drawer->mediumOf(withoutMedium, notes);
    drawer_ = std::move(drawer);
    notes_ = notes;
    history_.reset(state);
    duration_ = durationOf(drawer_->scene());
    playback.isPlaying = false;
    exposure_.reset();
    frameTimes_.clear();
    drawn_ = Drawn::Nothing;
    changed();
    say("loaded " + host::printable(result.file.string()));
  } catch (const host::Error& error) {
    say(error.what(), true);
  }
  loadedState_.reset();
}

void Viewer::edit(const std::string& what, const settings::State& state) {
  const std::string contradiction = contradictionIn(state);
  if (!contradiction.empty()) return say(contradiction, true);
  history_.edit(what, state);
  changed();
}

void Viewer::undo() {
  history_.undo();
  changed();
}

void Viewer::redo() {
  history_.redo();
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
    return drawer_->cameraOf(history_.state(), pose, ofNoConcern);
  } catch (const host::Error&) { // which is said when it is drawn
    return host::makeDefaultCamera(drawer_->scene(), pose, 1, {}, ofNoConcern);
  }
}

LookAt Viewer::view() const {
  const settings::State& state = history_.state();
  if (state.lookAt || !drawer_) return state.lookAt.value_or(LookAt());
  const std::vector<glm::dmat4> pose = host::poseAt(drawer_->scene(), state.seconds);
  const host::Bounds bounds = host::boundsOf(drawer_->scene(), pose);
  const tyndall::Camera camera = sceneCamera(pose);
  const LookAt near = lookAtOf(camera, 1);
  const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
  const double toMiddle = glm::dot(middle - near.eye, glm::normalize(near.target - near.eye));
  const double size = glm::length(bounds.high - bounds.low);
  return lookAtOf(camera, std::max({toMiddle, 0.05 * size, 1e-3}));
}

void Viewer::setView(const LookAt& view) {
  settings::State state = history_.state();
  state.lookAt = view;
  state.camera.reset();
  const std::string contradiction = contradictionIn(state);
  if (!contradiction.empty() || !std::isfinite(glm::length(view.eye) + glm::length(view.target))) return;
  history_.move(state);
  changed();
}

void Viewer::useSceneCamera(int index) {
  if (!drawer_ || index < 0 || index >= static_cast<int>(host::cameraNodes(drawer_->scene()).size())) return;
  settings::State state = history_.state();
  state.lookAt.reset();
  state.camera = index;
  history_.move(state);
  changed();
}

void Viewer::frameAll() {
  if (!drawer_) return;
  const settings::State& state = history_.state();
  const host::Bounds bounds = host::boundsOf(drawer_->scene(), host::poseAt(drawer_->scene(), state.seconds));
  setView(framed(view(), bounds, static_cast<double>(state.width) / state.height));
}

void Viewer::setSeconds(double seconds) {
  settings::State state = history_.state();
  if (state.seconds == seconds) return;
  state.seconds = seconds;
  history_.move(state);
  changed();
}

void Viewer::compareWith(const std::optional<tyndall::Settings>& settings) {
  compared_ = settings;
  if (!compared_) showsSecond_ = false;
  changed();
}

} // namespace viewer
