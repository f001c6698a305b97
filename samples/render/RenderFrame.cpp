#include "RenderFrame.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <gl/CameraView.h>
#include <gl/Driver.h>
#include <gl/Gl.h>
#include <gl/ReadBack.h>
#include <scene/Advice.h>
#include <scene/Error.h>
#include <scene/GltfLoader.h>
#include <scene/MediumFile.h>
#include <scene/MovedObjects.h>
#include <scene/ProgramFiles.h>
#include <scene/Projection.h>
#include <scene/ShadowViews.h>
#include <scene/Smoke.h>
#include <scene/Strands.h>

namespace render {

namespace {

constexpr double kFramesPerSecond = 24;

/// Timer queries of a software rasteriser measure when commands were queued, not when they ran.
tyndall::PassTiming timingFor(const std::string& driver) {
  return host::isSoftware(driver) ? tyndall::PassTiming::Finish : tyndall::PassTiming::TimerQuery;
}

host::RenderTargetOptions targetOptions(const Options& options) {
  host::RenderTargetOptions target;
  target.width = renderedWidth(options);
  target.height = renderedHeight(options);
  target.colourFormat = GL_RGBA32F;
  return target;
}

host::RenderTargetOptions sampledOptions(const Options& options) {
  host::RenderTargetOptions target = targetOptions(options);
  target.samples = options.msaa;
  return target;
}

/// Digits of a number after the point, in reverse.
double radicalInverse(int number, int base) {
  double result = 0, place = 1;
  for (; number > 0; number /= base)
    result += (place /= base) * (number % base);
  return result;
}

tyndall::Medium mediumOf(const Options& options, const host::Scene& scene, host::Notes& notes) {
  if (options.mediumFile) return host::loadMedium(*options.mediumFile);
  if (options.medium) return *options.medium;
  return host::mediumOf(scene, host::boundsOf(scene, host::poseAt(scene, 0)), notes);
}

tyndall::ClipDepth clipDepthOf(const Options& options) {
  return options.reversedDepth ? tyndall::ClipDepth::ZeroToOne : tyndall::ClipDepth::NegativeOneToOne;
}

/// Distances along the view axis. The scene's depth runs over (0, 1) whatever its direction.
std::vector<float> viewZ(std::vector<float> depth, const tyndall::Camera& camera, bool reversed) {
  const glm::dmat4 viewFromClip = glm::inverse(host::fromMat4(camera.clipFromView));
  const float sky = reversed ? 0.0F : 1.0F;
  const bool isZeroToOne = camera.clipDepth == tyndall::ClipDepth::ZeroToOne;
  for (float& value : depth) {
    const double ndc = isZeroToOne ? value : 2.0 * value - 1.0;
    const glm::dvec4 view = viewFromClip * glm::dvec4(0, 0, ndc, 1);
    value = value == sky ? kSkyZ : static_cast<float>(-view.z / view.w);
  }
  return depth;
}

void addOnce(host::Notes& notes, const host::Notes& more) {
  for (const std::string& note : more)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

} // namespace

double Measurement::median() const {
  const std::size_t count = milliseconds.size();
  return 0.5 * (milliseconds[(count - 1) / 2] + milliseconds[count / 2]);
}

FrameRenderer::FrameRenderer(const Options& options)
    : options_(options),
      context_(host::Context::create(options.context ? *options.context : host::defaultContextKind(), {options.debug})),
      scene_(host::loadScene(options.scene)), notes_(scene_.notes),
      sceneRenderer_(std::make_unique<host::SceneRenderer>(scene_)), surfaces_(sampledOptions(options)),
      composite_(targetOptions(options)),
      inscatter_(host::makeTexture2D(GL_RGBA32F, surfaces_.width(), surfaces_.height())),
      transmittance_(host::makeTexture2D(GL_RGBA32F, surfaces_.width(), surfaces_.height())) {
  tyndall::Config config;
  config.loader = context_->loader();
  config.timing = timingFor(context_->driver());
  config.tuning = options.tuning;
  config.checkInputs = options.checkInputs;
  if (options.programs) config.programs = host::programFiles(*options.programs);
  tyndall::CreateResult created = tyndall::Effect::create(config);
  if (!created.status) throw host::Error("effect: " + created.status.message);
  effect_ = std::move(created.effect);
  meshBounds_ = host::meshBounds(scene_);
  if (hasVolumes()) makeVolumeShadows();

  frame_.medium = mediumOf(options, scene_, notes_);
  frame_.viewport.width = surfaces_.width();
  frame_.viewport.height = surfaces_.height();
  frame_.colour = composite_.colour();
  frame_.depth.texture = surfaces_.depth();
  frame_.depth.multisampled = surfaces_.multisampled();
  frame_.output.inscatter = inscatter_.name();
  frame_.output.transmittance = transmittance_.name();
  frame_.settings = options.settings;
  frame_.reuse = options.reuse;
}

tyndall::Camera FrameRenderer::makeCamera(const std::vector<glm::dmat4>& worldFromNode, host::Notes& notes) const {
  const host::CameraOptions cameraOptions{options_.reversedDepth, clipDepthOf(options_)};
  const double aspect = static_cast<double>(options_.width) / options_.height;
  if (options_.lookAt)
    return host::makeLookAt(scene_, worldFromNode, options_.lookAt->eye, options_.lookAt->target,
                            options_.lookAt->fovDegrees, aspect, cameraOptions);
  if (!options_.camera && host::cameraNodes(scene_).empty())
    return host::makeDefaultCamera(scene_, worldFromNode, aspect, cameraOptions, notes);
  return host::makeCamera(scene_, worldFromNode, options_.camera.value_or(0), aspect, cameraOptions);
}

std::vector<tyndall::Light> FrameRenderer::makeLights(const std::vector<glm::dmat4>& worldFromNode,
                                                      host::Notes& notes) const {
  if (!options_.sun && options_.lights) {
    host::Notes ofNoConcern;
    return settings::lightsOf(*options_.lights, host::makeLights(scene_, worldFromNode, ofNoConcern));
  }
  if (!options_.sun) return host::makeLights(scene_, worldFromNode, notes);
  tyndall::Light sun = host::makeSun(options_.sun->direction);
  if (options_.sun->colour) sun.colour = {options_.sun->colour->r, options_.sun->colour->g, options_.sun->colour->b};
  return {sun};
}

bool FrameRenderer::hasVolumes() const { return !scene_.smoke.empty() || host::hasStrands(scene_); }

void FrameRenderer::makeVolumeShadows() {
  if (!options_.avsm) return;
  constexpr int kNeeded = 43;
  const int version = context_->glVersion();
  if (version >= kNeeded) {
    volumeShadows_ = std::make_unique<VolumeShadows>(context_->loader(), timingFor(context_->driver()),
                                                     options_.avsmSize, options_.avsmNodes);
    return;
  }
  notes_.push_back("smoke and strands are drawn without their shadows: adaptive volumetric shadow maps need OpenGL "
                   "4.3, and the context has " +
                   std::to_string(version / 10) + "." + std::to_string(version % 10));
}

// For the effect: surfaces read arrays.
void FrameRenderer::layOutMaps() {
  const host::MapForm& form = options_.mapForm;
  const bool isPlain = form.layout == host::MapLayout::Array && form.encoding == tyndall::DepthEncoding::Window;
  if (isPlain) return;
  if (!shadowLayout_) shadowLayout_ = std::make_unique<host::ShadowLayout>(form);
  laidOutMaps_.clear();
  for (tyndall::Light& light : frame_.lights)
    laidOutMaps_.push_back(shadowLayout_->layOut(light, options_.shadowSize));
}

void FrameRenderer::renderShadowMaps(const std::vector<glm::dmat4>& worldFromNode, double seconds, host::Notes& notes) {
  shadowMaps_.clear();
  const bool cubeFaces = options_.mapForm.layout == host::MapLayout::Cube;
  const host::ShadowOptions shadowOptions{options_.reversedDepth, clipDepthOf(options_), options_.cascades, cubeFaces,
                                          seconds};
  for (tyndall::Light& light : frame_.lights) {
    addOnce(notes, host::fitShadowViews(light, scene_, worldFromNode, frame_.camera, shadowOptions));
    if (light.shadow.views.empty()) continue;
    const bool isScene = options_.sun || !options_.lights;
    if (isScene && light.shadow.views.size() > 1 && light.kind == tyndall::LightKind::Directional)
      light.cascadeFade = options_.cascadeFade;
    shadowMaps_.push_back(sceneRenderer_->renderShadowMap(worldFromNode, light, options_.shadowSize));
    shadowMaps_.back().attachTo(light);
  }
  if (!hasVolumes()) return;
  sceneRenderer_->setVolumes(host::smokeAt(scene_, seconds), host::strandsAt(scene_, worldFromNode));
  if (volumeShadows_) volumeShadows_->update(*sceneRenderer_, frame_.lights);
}

/// Whether nothing that the light sends into the medium reaches the eye: the inscatter by itself is 0 everywhere.
bool FrameRenderer::isKeptOut(const tyndall::Light& light) {
  tyndall::Frame frame = frame_;
  frame.lights = {light};
  frame.colour = 0;
  frame.output.transmittance = 0;
  frame.settings = tyndall::settingsOf(tyndall::Profile::High);
  frame.reuse = {};
  renderEffect(frame);
  const std::vector<float> inscatter =
      host::readColour(inscatter_.name(), frame.viewport.width, frame.viewport.height, 3);
  return std::all_of(inscatter.begin(), inscatter.end(), [](float value) { return value == 0; });
}

void FrameRenderer::noteEnclosures(const std::vector<glm::dmat4>& worldFromNode, host::Notes& notes) {
  const auto sum = [](const tyndall::Rgb& rgb) { return rgb[0] + rgb[1] + rgb[2]; };
  const auto scatters = [&](const tyndall::Constituent& constituent) { return sum(constituent.scattering) > 0; };
  const std::vector<tyndall::Constituent>& constituents = frame_.medium.constituents;
  if (std::none_of(constituents.begin(), constituents.end(), scatters)) return;
  for (const host::Enclosure& enclosure : host::enclosuresOf(scene_, worldFromNode, frame_.camera, frame_.lights)) {
    const tyndall::Light& light = frame_.lights[static_cast<std::size_t>(enclosure.light)];
    if (sum(light.colour) > 0 && isKeptOut(light))
      notes.push_back(enclosure.mesh + " encloses the camera and all that it sees: light " +
                      std::to_string(enclosure.light) + " is kept out; what is KHR_materials_unlit lets light in");
  }
}

/// The surfaces' radiance is cut at what their colour format holds.
void FrameRenderer::noteCutRadiance(host::Notes& notes) const {
  const float most = surfaces_.maxRadiance();
  const std::vector<float> colour = host::readColour(surfaces_.colour(), surfaces_.width(), surfaces_.height(), 3);
  const auto cut = std::count_if(colour.begin(), colour.end(), [most](float value) { return value >= most; });
  if (cut > 0) notes.push_back(fmt::format("radiance of surfaces is cut at {:g}, the most that is held", most));
}

// Smoke moves in every frame: all of the box around it may dim the light anew.
void FrameRenderer::addMovedObjects(const std::vector<glm::dmat4>& worldFromNode, double seconds) {
  frame_.objects = host::movedObjects(scene_, meshBounds_, lastPose_, worldFromNode);
  if (!volumeShadows_) return;
  for (const host::SmokeEmitter& emitter : scene_.smoke)
    frame_.objects.push_back(
        host::movedBox(host::smokeBounds(scene_, emitter, lastSeconds_), host::smokeBounds(scene_, emitter, seconds)));
}

// As for temporal antialiasing: after the shadow views were fitted, which do not follow.
void FrameRenderer::jitterCamera(int frame) {
  if (options_.halton == 0) return;
  const int place = frame % options_.halton + 1;
  tyndall::Camera& camera = frame_.camera;
  camera.jitter = {radicalInverse(place, 2) - 0.5, radicalInverse(place, 3) - 0.5};
  const glm::dvec3 ndc(2 * camera.jitter[0] / frame_.viewport.width, 2 * camera.jitter[1] / frame_.viewport.height, 0);
  camera.clipFromView = host::toMat4(host::translation(ndc) * host::fromMat4(camera.clipFromView));
}

// One of a pixel's samples, for the picture's Z.
void FrameRenderer::resolveDepth() const {
  if (!surfaces_.multisampled()) return;
  const GladGLContext& functions = host::gl();
  functions.BindFramebuffer(GL_READ_FRAMEBUFFER, surfaces_.framebuffer());
  functions.BindFramebuffer(GL_DRAW_FRAMEBUFFER, composite_.framebuffer());
  functions.Disable(GL_SCISSOR_TEST);
  functions.BlitFramebuffer(0, 0, frame_.viewport.width, frame_.viewport.height, 0, 0, frame_.viewport.width,
                            frame_.viewport.height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  functions.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void FrameRenderer::restoreColour() const {
  const GladGLContext& functions = host::gl();
  functions.BindFramebuffer(GL_READ_FRAMEBUFFER, surfaces_.framebuffer());
  functions.BindFramebuffer(GL_DRAW_FRAMEBUFFER, composite_.framebuffer());
  functions.Disable(GL_SCISSOR_TEST);
  functions.BlitFramebuffer(0, 0, frame_.viewport.width, frame_.viewport.height, 0, 0, frame_.viewport.width,
                            frame_.viewport.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  functions.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

double FrameRenderer::renderEffect(const tyndall::Frame& frame) {
  restoreColour();
  host::gl().Finish();
  const auto start = std::chrono::steady_clock::now();
  const tyndall::Status status = effect_->render(frame);
  host::gl().Finish();
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  if (!status) throw host::Error("effect: " + status.message);
  return time.count();
}

// With --repeat, the timed renders blend straight into the colour, as an engine's do; a last one writes the picture's
// other channels too.
Measurement FrameRenderer::measure() {
  struct Run {
    double milliseconds;
    tyndall::Statistics statistics;
  };
  std::vector<Run> runs;
  tyndall::Frame timed = frame_;
  if (options_.repeat) {
    timed.output = {};
    renderEffect(timed); // warms up
  }
  for (int i = 0; i < options_.repeat.value_or(1); ++i) {
    const double milliseconds = renderEffect(timed);
    runs.push_back({milliseconds, effect_->statistics()});
  }
  if (options_.repeat) renderEffect(frame_);
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.milliseconds < b.milliseconds; });
  Measurement measurement;
  for (const Run& run : runs)
    measurement.milliseconds.push_back(run.milliseconds);
  measurement.statistics = runs[(runs.size() - 1) / 2].statistics;
  return measurement;
}

void FrameRenderer::throwGlErrors() const {
  const std::vector<std::string> errors = context_->takeErrors();
  if (!errors.empty()) throw host::Error("OpenGL: " + errors.front());
}

void FrameRenderer::draw(int frame) {
  const double seconds = options_.seconds + frame / kFramesPerSecond;
  const std::vector<glm::dmat4> worldFromNode = host::poseAt(scene_, seconds);
  host::Notes notes;
  frame_.camera = makeCamera(worldFromNode, notes);
  frame_.lights = makeLights(worldFromNode, notes);
  const glm::vec3 sky = host::skyOf(scene_, worldFromNode, frame_.lights, notes);
  renderShadowMaps(worldFromNode, seconds, notes);
  jitterCamera(frame);
  const bool isFirst = lastPose_.empty();
  if (isFirst) addOnce(notes, host::adviceOn(scene_, worldFromNode, frame_.camera));
  sceneRenderer_->renderScene(worldFromNode, frame_.camera, frame_.lights, surfaces_, sky, &frame_.medium);
  resolveDepth();
  layOutMaps();
  if (isFirst) noteEnclosures(worldFromNode, notes);
  if (!options_.out.empty()) noteCutRadiance(notes);
  addOnce(notes_, notes);
  ++frame_.reuse.frame;
  frame_.objects.clear();
  if (options_.reuse.changes == tyndall::Changes::Objects && !lastPose_.empty())
    addMovedObjects(worldFromNode, seconds);
  lastPose_ = worldFromNode;
  lastSeconds_ = seconds;
  throwGlErrors();
}

Measurement FrameRenderer::render(int frame) {
  draw(frame);
  if (options_.checkInputs) renderEffect(frame_); // what it finds is known in the next
  Measurement measurement = measure();
  addOnce(notes_, measurement.statistics.warnings);
  if (volumeShadows_) measurement.volumeShadows = volumeShadows_->statistics();
  throwGlErrors();
  return measurement;
}

Picture FrameRenderer::readPicture() const {
  Picture picture;
  picture.composite = host::readColour(composite_.colour(), frame_.viewport.width, frame_.viewport.height);
  picture.inscatter = host::readColour(inscatter_.name(), frame_.viewport.width, frame_.viewport.height);
  picture.transmittance = host::readColour(transmittance_.name(), frame_.viewport.width, frame_.viewport.height);
  picture.z = viewZ(host::readDepth((surfaces_.multisampled() ? composite_ : surfaces_).depth(), frame_.viewport.width,
                                    frame_.viewport.height),
                    frame_.camera, options_.reversedDepth);
  throwGlErrors();
  return picture;
}

} // namespace render
