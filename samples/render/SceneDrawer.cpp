#include "SceneDrawer.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gl/Driver.h>
#include <gl/Pause.h>
#include <scene/Advice.h>
#include <scene/Error.h>
#include <scene/Fog.h>
#include <scene/MovedObjects.h>
#include <scene/Projection.h>
#include <scene/ShadowViews.h>
#include <scene/Smoke.h>
#include <scene/Strands.h>
#include <scene/WorldGeometry.h>

namespace render {

namespace {

/// Digits of a number after the point, in reverse.
double radicalInverse(int number, int base) {
  double result = 0, place = 1;
  for (; number > 0; number /= base)
    result += (place /= base) * (number % base);
  return result;
}

// As for temporal antialiasing: after the shadow views were fitted, which do not follow.
void jitterCamera(const settings::State& state, int frame, tyndall::Camera& camera) {
  if (state.halton == 0) return;
  const int place = frame % state.halton + 1;
  camera.jitter = {radicalInverse(place, 2) - 0.5, radicalInverse(place, 3) - 0.5};
  const glm::dvec3 ndc(2 * camera.jitter[0] / renderedWidth(state), 2 * camera.jitter[1] / renderedHeight(state), 0);
  camera.clipFromView = host::toMat4(host::translation(ndc) * host::fromMat4(camera.clipFromView));
}

tyndall::ClipDepth clipDepthOf(const settings::State& state) {
  return state.reversedDepth ? tyndall::ClipDepth::ZeroToOne : tyndall::ClipDepth::NegativeOneToOne;
}

double gibibytes(std::uint64_t bytes) { return static_cast<double>(bytes) / (1U << 30); }

template <typename Numbers>
void append(std::vector<double>& key, const Numbers& numbers) {
  for (const auto number : numbers)
    key.push_back(static_cast<double>(number));
}

void append(std::vector<double>& key, const glm::dmat4& matrix) { append(key, host::toMat4(matrix)); }

/// All that a light's maps show, but the scene.
void appendCause(std::vector<double>& key, const tyndall::Light& light) {
  append(key, light.position);
  append(key, light.direction);
  append(key, std::initializer_list<double>{static_cast<double>(light.kind), light.range, light.outerConeAngle,
                                            static_cast<double>(light.shadow.clipDepth),
                                            light.shadow.views.empty() ? 0.0 : 1.0});
}

/// And its light on surfaces.
void appendLit(std::vector<double>& key, const tyndall::Light& light) {
  append(key, light.colour);
  append(key, light.boundary.point);
  append(key, light.boundary.normal);
  append(key, std::initializer_list<double>{light.innerConeAngle, light.cascadeFade, double(light.litOutsideViews),
                                            double(light.boundary.enabled)});
}

void append(std::vector<double>& key, const tyndall::Medium& medium) {
  append(key, medium.absorption);
  key.push_back(medium.farDistance);
  for (const tyndall::Constituent& constituent : medium.constituents) {
    append(key, constituent.scattering);
    key.push_back(constituent.layer);
  }
  append(key, medium.up);
  key.push_back(medium.absorptionLayer);
  for (const tyndall::HeightLayer& layer : medium.layers)
    append(key, std::initializer_list<double>{layer.height, layer.scale, layer.ground});
}

} // namespace

tyndall::PassTiming timingFor(const host::Context& context) {
  return host::isSoftware(context.driver()) ? tyndall::PassTiming::Finish : tyndall::PassTiming::TimerQuery;
}

void addOnce(host::Notes& notes, const host::Notes& more) {
  for (const std::string& note : more)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

SceneDrawer::SceneDrawer(host::Scene scene, const host::Context& context, const settings::State& state,
                         host::Notes& notes)
    : context_(context), scene_(std::move(scene)), boxes_(host::boxesOf(scene_)),
      renderer_(std::make_unique<host::SceneRenderer>(scene_)), meshBounds_(host::meshBounds(scene_)) {
  makeVolumeShadows(state, notes);
}

bool SceneDrawer::hasVolumes() const {
  return !scene_.smoke.empty() || !scene_.fog.empty() || host::hasStrands(scene_);
}

// Again where the state has others.
void SceneDrawer::makeVolumeShadows(const settings::State& state, host::Notes& notes) {
  if (!scene_.fog.empty() && !(state.avsm && state.eyeCurves))
    addOnce(notes, {"fog is not drawn without maps of smoke, fog and strands, and curves before the eye"});
  const bool isMade = avsm_.isOn == state.avsm && avsm_.size == state.avsmSize && avsm_.nodes == state.avsmNodes;
  if (!hasVolumes() || isMade) return;
  avsm_ = {state.avsm, state.avsmSize, state.avsmNodes};
  volumeShadows_.reset();
  volumesKey_.clear();
  eyeKey_.clear();
  if (!state.avsm) return;
  constexpr int kNeeded = 43;
  const int version = context_.glVersion();
  if (version >= kNeeded) {
    volumeShadows_ =
        std::make_unique<VolumeShadows>(context_.loader(), timingFor(context_), state.avsmSize, state.avsmNodes);
    if (!scene_.fog.empty() && !fog_) fog_.emplace();
    return;
  }
  notes.push_back(
      "smoke and strands are drawn without their shadows, and fog is not: adaptive volumetric shadow maps need OpenGL "
      "4.3, and the context has " +
      std::to_string(version / 10) + "." + std::to_string(version % 10));
}

tyndall::Medium SceneDrawer::mediumOf(const settings::State& state, host::Notes& notes) const {
  if (state.medium) return *state.medium;
  const std::vector<glm::dmat4> pose = host::poseAt(scene_, 0);
  host::Bounds bounds = host::boundsOf(scene_, pose);
  for (const host::Bounds& box : host::fogBounds(scene_, pose))
    bounds = {glm::min(bounds.low, box.low), glm::max(bounds.high, box.high)};
  return host::mediumOf(scene_, bounds, notes);
}

tyndall::Ambient SceneDrawer::ambientOf(const settings::State& state) const {
  return state.ambient ? *state.ambient : scene_.ambient.value_or(tyndall::Ambient());
}

settings::StateFog SceneDrawer::fogOf(const settings::State& state) const {
  settings::StateFog fog{scene_.fogScattering.value_or(host::FogScattering()), scene_.fog};
  if (!state.fog) return fog;
  fog.scattering = state.fog->scattering;
  for (std::size_t i = 0; i < std::min(fog.banks.size(), state.fog->banks.size()); ++i) {
    const host::FogBank& own = state.fog->banks[i];
    host::FogBank& bank = fog.banks[i];
    bank.extinction = own.extinction;
    bank.fade = own.fade;
    bank.clear = own.clear;
    bank.seed = own.seed;
  }
  return fog;
}

bool SceneDrawer::lightsFog(const settings::State& state) const {
  const bool isSmokeLit = !scene_.smoke.empty() && scene_.fogScattering && state.litSmoke;
  return volumeShadows_ && state.eyeCurves && (!scene_.fog.empty() || isSmokeLit);
}

tyndall::Camera SceneDrawer::cameraOf(const host::Scene& scene, const settings::State& state,
                                      const std::vector<glm::dmat4>& worldFromNode, host::Notes& notes) {
  const host::CameraOptions cameraOptions{state.reversedDepth, clipDepthOf(state)};
  const double aspect = static_cast<double>(state.width) / state.height;
  if (state.lookAt)
    return host::makeLookAt(scene, worldFromNode, state.lookAt->eye, state.lookAt->target, state.lookAt->fovDegrees,
                            aspect, cameraOptions);
  if (!state.camera && host::cameraNodes(scene).empty())
    return host::makeDefaultCamera(scene, worldFromNode, aspect, cameraOptions, notes);
  return host::makeCamera(scene, worldFromNode, state.camera.value_or(0), aspect, cameraOptions);
}

std::vector<tyndall::Light> SceneDrawer::lightsOf(const settings::State& state, const Moment& moment,
                                                  const std::vector<glm::dmat4>& worldFromNode,
                                                  host::Notes& notes) const {
  if (moment.sun) return {*moment.sun};
  if (!state.lights) return host::makeLights(scene_, worldFromNode, notes);
  host::Notes ofNoConcern;
  return settings::lightsOf(*state.lights, host::makeLights(scene_, worldFromNode, ofNoConcern));
}

// Which walls are around a scene is not asked again while only the camera moves, or what is seen is coarse.
glm::vec3 SceneDrawer::skyOf(const Moment& moment, const std::vector<glm::dmat4>& worldFromNode,
                             const std::vector<tyndall::Light>& lights, host::Notes& notes) {
  std::vector<double> key = {1};
  for (const tyndall::Light& light : lights)
    if (light.kind == tyndall::LightKind::Directional) append(key, light.colour);
  const bool isKnown =
      moment.isCoarse && skyKey_.size() >= key.size() && std::equal(key.begin(), key.end(), skyKey_.begin());
  for (const glm::dmat4& matrix : worldFromNode)
    append(key, matrix);
  if (!isKnown && key != skyKey_) {
    skyNotes_.clear();
    sky_ = host::skyOf(scene_, worldFromNode, lights, skyNotes_);
    skyKey_ = std::move(key);
  }
  addOnce(notes, skyNotes_);
  return sky_;
}

void SceneDrawer::fitViews(const settings::State& state, const Moment& moment,
                           const std::vector<glm::dmat4>& worldFromNode, tyndall::Frame& frame,
                           host::Notes& notes) const {
  const bool cubeFaces = state.mapForm.layout == host::MapLayout::Cube;
  const bool areScenes = moment.sun || !state.lights;
  const int steadyTexels = state.steadyShadows ? state.shadowSize : 0;
  const host::ShadowOptions shadowOptions{state.reversedDepth, clipDepthOf(state), state.cascades,
                                          steadyTexels,        cubeFaces,          moment.seconds};
  for (tyndall::Light& light : frame.lights) {
    addOnce(notes, host::fitShadowViews(light, fittedTo(moment), worldFromNode, frame.camera, shadowOptions));
    const bool isCascaded = light.shadow.views.size() > 1 && light.kind == tyndall::LightKind::Directional;
    if (isCascaded && areScenes) light.cascadeFade = state.cascadeFade;
  }
}

/// Whether the light's maps are those that were drawn last: as they are wanted, or, while things move, of a lamp that
/// stands still, as they were, unless the effect would take long for so many texels.
bool SceneDrawer::isMapped(const MappedLight& last, const MappedLight& now, const Moment& moment) {
  if (last.cause != now.cause) return false;
  if (last.size == now.size && last.views == now.views) return true;
  constexpr int kMostTimes = 4;
  const bool hasEnough = last.size >= now.size && last.size <= kMostTimes * now.size;
  return moment.isCoarse && now.light.kind != tyndall::LightKind::Directional && hasEnough;
}

std::vector<double> SceneDrawer::volumesKeyOf(const settings::State& state, const Moment& moment,
                                              const std::vector<glm::dmat4>& worldFromNode) const {
  std::vector<double> key = {1};
  if (!scene_.smoke.empty() || host::hasStrands(scene_)) {
    append(key, std::initializer_list<double>{moment.seconds, state.smokeDensity, state.strandWidth,
                                              state.strandOpacity, double(moment.isCoarse), double(lightsFog(state))});
    for (const glm::dmat4& matrix : worldFromNode)
      append(key, matrix);
  }
  for (const host::FogBank& bank : fogOf(state).banks) {
    append(key, std::initializer_list<double>{bank.extinction, bank.fade, bank.clear, double(bank.seed)});
    append(key, worldFromNode[static_cast<std::size_t>(bank.node)]);
  }
  for (const MappedLight& light : mapped_) {
    key.push_back(static_cast<double>(light.views.size()));
    key.insert(key.end(), light.views.begin(), light.views.end());
  }
  return key;
}

void SceneDrawer::checkMapBytes(const settings::State& state, const tyndall::Frame& frame) const {
  std::uint64_t views = 0;
  for (const tyndall::Light& light : frame.lights)
    views += light.shadow.views.size();
  const std::uint64_t texelBytes = renderer_->hasGlass() ? 16 : 4; // depth; colour and depth of glass
  const auto side = static_cast<std::uint64_t>(state.shadowSize);
  const std::uint64_t bytes = views * side * side * texelBytes;
  if (bytes > mostMapBytes)
    throw host::Error(fmt::format("maps.shadowSize: {} makes {:.1f} GiB of {} shadow maps, of at most {:.1f}",
                                  state.shadowSize, gibibytes(bytes), views, gibibytes(mostMapBytes)));
}

void SceneDrawer::setVolumes(const settings::State& state, const Moment& moment,
                             const std::vector<glm::dmat4>& worldFromNode) {
  std::vector<host::SmokeParticle> smoke = host::smokeAt(scene_, moment.seconds);
  for (host::SmokeParticle& particle : smoke)
    particle.density *= state.smokeDensity;
  constexpr int kFew = 8; // strands for one that is drawn while things move
  host::Strands strands = host::strandsAt(scene_, worldFromNode);
  if (moment.isCoarse) strands = host::thinned(strands, kFew);
  for (host::StrandPoint& point : strands.points) {
    point.strand.width *= state.strandWidth;
    point.strand.opacity *= state.strandOpacity;
  }
  renderer_->setVolumes(std::move(smoke), std::move(strands), !lightsFog(state));
}

void SceneDrawer::drawMaps(const settings::State& state, const Moment& moment,
                           const std::vector<glm::dmat4>& worldFromNode, tyndall::Frame& frame) {
  checkMapBytes(state, frame);
  mapped_.resize(frame.lights.size());
  for (std::size_t i = 0; i < mapped_.size(); ++i) {
    tyndall::Light& light = frame.lights[i];
    MappedLight now;
    now.light = light;
    now.size = state.shadowSize;
    appendCause(now.cause, light);
    for (const glm::dmat4& matrix : worldFromNode)
      append(now.cause, matrix);
    for (const tyndall::ShadowView& view : light.shadow.views)
      append(now.views, view.clipFromWorld);
    if (!isMapped(mapped_[i], now, moment)) {
      surfacesKey_.clear();
      mapped_[i] = {}; // of an attempt that fails
      if (!light.shadow.views.empty()) {
        now.textures = renderer_->renderShadowMap(worldFromNode, light, state.shadowSize);
        now.textures.attachTo(now.light);
      }
      mapped_[i] = std::move(now);
    }
    light.shadow = mapped_[i].light.shadow;
    light.glass = mapped_[i].light.glass;
  }
  if (hasVolumes()) drawVolumes(state, moment, worldFromNode, frame);
}

void SceneDrawer::drawVolumes(const settings::State& state, const Moment& moment,
                              const std::vector<glm::dmat4>& worldFromNode, tyndall::Frame& frame) {
  std::vector<double> key = volumesKeyOf(state, moment, worldFromNode);
  if (key != volumesKey_) {
    volumesKey_.clear();
    surfacesKey_.clear();
    setVolumes(state, moment, worldFromNode);
    if (volumeShadows_ && fog_) {
      fog_->set(fogOf(state).banks);
      volumeShadows_->setFog(fog_->at(worldFromNode));
    }
    if (volumeShadows_) volumeShadows_->update(*renderer_, frame.lights);
    curves_.clear();
    for (const tyndall::Light& light : frame.lights)
      curves_.push_back(light.curves);
    volumesKey_ = std::move(key);
  }
  for (std::size_t i = 0; i < curves_.size(); ++i)
    frame.lights[i].curves = curves_[i];
}

void SceneDrawer::drawSurfaces(const std::vector<glm::dmat4>& worldFromNode, const glm::vec3& sky,
                               host::RenderTargets& surfaces, const tyndall::Frame& frame) {
  std::vector<double> key = {static_cast<double>(surfaces.width()), static_cast<double>(surfaces.height())};
  append(key, frame.camera.viewFromWorld);
  append(key, frame.camera.clipFromView);
  append(key, frame.medium);
  append(key, std::initializer_list<double>{sky.r, sky.g, sky.b});
  for (const tyndall::Light& light : frame.lights)
    appendLit(key, light);
  if (key == surfacesKey_) return;
  surfacesKey_.clear();
  renderer_->renderScene(worldFromNode, frame.camera, frame.lights, surfaces, sky, &frame.medium);
  surfacesKey_ = std::move(key);
}

// For the effect: surfaces read arrays.
void SceneDrawer::layOutMaps(const settings::State& state, tyndall::Frame& frame) {
  const host::MapForm& form = state.mapForm;
  const bool isPlain = form.layout == host::MapLayout::Array && form.encoding == tyndall::DepthEncoding::Window;
  if (isPlain) return;
  if (!shadowLayout_ || mapForm_.layout != form.layout || mapForm_.encoding != form.encoding)
    shadowLayout_ = std::make_unique<host::ShadowLayout>(form);
  mapForm_ = form;
  laidOutMaps_.clear();
  for (tyndall::Light& light : frame.lights)
    laidOutMaps_.push_back(shadowLayout_->layOut(light, state.shadowSize));
}

namespace {

/// How far a box reaches along a camera's axis, from the eye or from an orthographic one's near plane.
std::array<double, 2> reachOf(const host::Bounds& box, const tyndall::Camera& camera, bool reversed) {
  const glm::dmat4 viewFromWorld = host::fromMat4(camera.viewFromWorld),
                   viewFromClip = glm::inverse(host::fromMat4(camera.clipFromView));
  const double nearest = reversed ? 1 : camera.clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
  const glm::dvec4 near = viewFromClip * glm::dvec4(0, 0, nearest, 1);
  const double begin = camera.clipFromView[15] != 0 ? -near.z / near.w : 0; // 0 in a perspective matrix
  std::array<double, 2> reach = {tyndall::kInfinity, -tyndall::kInfinity};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                       corner & 4 ? box.high.z : box.low.z);
    const double distance = -(viewFromWorld * glm::dvec4(p, 1)).z - begin;
    reach = {std::min(reach[0], distance), std::max(reach[1], distance)};
  }
  return reach;
}

} // namespace

// What smoke and fog leave of the light behind them, between the planes that hold all of them; and what is lit of them
// scatters.
void SceneDrawer::seeThroughVolumes(const settings::State& state, const Moment& moment,
                                    const std::vector<glm::dmat4>& worldFromNode, const host::RenderTargets& image,
                                    tyndall::Frame& frame) {
  frame.eyeCurves = {};
  double near = tyndall::kInfinity, far = 0;
  std::vector<host::Bounds> boxes = host::fogBounds(scene_, worldFromNode);
  for (const host::SmokeEmitter& emitter : scene_.smoke)
    boxes.push_back(host::smokeBounds(scene_, emitter, moment.seconds));
  for (const host::Bounds& box : boxes) {
    const auto reach = reachOf(box, frame.camera, state.reversedDepth);
    near = std::min(near, reach[0]);
    far = std::max(far, reach[1]);
  }
  constexpr double kNearest = 1e-4, kThinnest = 1e-3; // of the farthest
  if (!volumeShadows_ || !state.eyeCurves || !(far > 0)) {
    if (volumeShadows_) volumeShadows_->forgetEye();
    eyeKey_.clear();
    return;
  }
  std::vector<double> key = volumesKey_;
  append(key, frame.camera.viewFromWorld);
  append(key, frame.camera.clipFromView);
  if (key != eyeKey_) {
    eyeKey_.clear();
    near = std::clamp(near, kNearest * far, (1 - kThinnest) * far);
    eyeCurves_ = volumeShadows_->before(*renderer_, frame.camera, {0, 0, image.width(), image.height()}, near, far,
                                        lightsFog(state));
    eyeKey_ = std::move(key);
  }
  frame.eyeCurves = eyeCurves_;
  if (!lightsFog(state)) return;
  const host::FogScattering fog = fogOf(state).scattering;
  frame.eyeCurves.albedo = fog.albedo;
  frame.eyeCurves.phase = fog.phase;
  frame.eyeCurves.g = fog.g;
  frame.eyeCurves.dimsBackground = true;
}

// Smoke moves in every frame: all of the box around it may dim the light anew.
std::vector<tyndall::MovingObject> SceneDrawer::movedObjects(const std::vector<glm::dmat4>& worldFromNode,
                                                             double seconds) const {
  std::vector<tyndall::MovingObject> objects = host::movedObjects(scene_, meshBounds_, pose_, worldFromNode);
  if (!volumeShadows_) return objects;
  for (const host::SmokeEmitter& emitter : scene_.smoke)
    objects.push_back(
        host::movedBox(host::smokeBounds(scene_, emitter, seconds_), host::smokeBounds(scene_, emitter, seconds)));
  return objects;
}

void SceneDrawer::draw(const settings::State& state, const Moment& moment, host::RenderTargets& surfaces,
                       tyndall::Frame& frame, host::Notes& notes) {
  makeVolumeShadows(state, notes);
  const std::vector<glm::dmat4> worldFromNode = host::poseAt(scene_, moment.seconds);
  frame.camera = cameraOf(fittedTo(moment), state, worldFromNode, notes);
  host::Pause::take();
  frame.lights = lightsOf(state, moment, worldFromNode, notes);
  const glm::vec3 sky = skyOf(moment, worldFromNode, frame.lights, notes);
  host::Pause::take();
  fitViews(state, moment, worldFromNode, frame, notes);
  host::Pause::take();
  drawMaps(state, moment, worldFromNode, frame);
  seeThroughVolumes(state, moment, worldFromNode, surfaces, frame);
  jitterCamera(state, moment.jitterPlace, frame.camera);
  const bool isFirst = pose_.empty();
  if (isFirst) addOnce(notes, host::adviceOn(scene_, worldFromNode, frame.camera));
  drawSurfaces(worldFromNode, sky, surfaces, frame);
  layOutMaps(state, frame);
  ++frame.reuse.frame;
  frame.objects.clear();
  if (state.reuse.changes == tyndall::Changes::Objects && !isFirst)
    frame.objects = movedObjects(worldFromNode, moment.seconds);
  pose_ = worldFromNode;
  seconds_ = moment.seconds;
}

} // namespace render
