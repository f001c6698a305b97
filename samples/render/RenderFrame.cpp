#include "RenderFrame.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <gl/CameraView.h>
#include <gl/Gl.h>
#include <gl/ReadBack.h>
#include <scene/Advice.h>
#include <scene/Error.h>
#include <scene/GltfLoader.h>
#include <scene/MediumFile.h>
#include <scene/ProgramFiles.h>
#include <scene/Projection.h>

namespace render {

namespace {

constexpr double kFramesPerSecond = 24;

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

settings::State stateOf(const Options& options) {
  settings::State state = options;
  if (options.mediumFile) state.medium = host::loadMedium(*options.mediumFile);
  if (options.ambientFile) state.ambient = host::loadAmbient(*options.ambientFile);
  return state;
}

Moment momentOf(const Options& options, int frame) {
  Moment moment;
  moment.seconds = options.seconds + frame / kFramesPerSecond;
  moment.jitterPlace = frame;
  if (!options.sun) return moment;
  moment.sun = host::makeSun(options.sun->direction);
  if (options.sun->colour)
    moment.sun->colour = {options.sun->colour->r, options.sun->colour->g, options.sun->colour->b};
  return moment;
}

} // namespace

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

double Measurement::median() const {
  const std::size_t count = milliseconds.size();
  return 0.5 * (milliseconds[(count - 1) / 2] + milliseconds[count / 2]);
}

FrameRenderer::FrameRenderer(const Options& options)
    : options_(options),
      context_(host::Context::create(options.context ? *options.context : host::defaultContextKind(), {options.debug})),
      surfaces_(sampledOptions(options)), composite_(targetOptions(options)),
      inscatter_(host::makeTexture2D(GL_RGBA32F, surfaces_.width(), surfaces_.height())),
      transmittance_(host::makeTexture2D(GL_RGBA32F, surfaces_.width(), surfaces_.height())) {
  host::Scene scene = host::loadScene(options.scene);
  notes_ = scene.notes;
  tyndall::Config config;
  config.loader = context_->loader();
  config.timing = timingFor(*context_);
  config.tuning = options.tuning;
  config.checkInputs = options.checkInputs;
  if (options.programs) config.programs = host::programFiles(*options.programs);
  tyndall::CreateResult created = tyndall::Effect::create(config);
  if (!created.status) throw host::Error("effect: " + created.status.message);
  effect_ = std::move(created.effect);
  drawer_ = std::make_unique<SceneDrawer>(std::move(scene), *context_, options_, notes_);

  const settings::State state = stateOf(options);
  frame_.medium = drawer_->mediumOf(state, notes_);
  frame_.ambient = drawer_->ambientOf(state);
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

/// Whether nothing that the light sends into the medium reaches the eye: the inscatter by itself is 0 everywhere.
bool FrameRenderer::isKeptOut(const tyndall::Light& light) {
  tyndall::Frame frame = frame_;
  frame.lights = {light};
  frame.ambient = {};
  frame.colour = 0;
  frame.output.transmittance = 0;
  frame.settings = tyndall::settingsOf(tyndall::Profile::High);
  frame.reuse = {};
  renderEffect(frame);
  const std::vector<float> inscatter =
      host::readColour(inscatter_.name(), frame.viewport.width, frame.viewport.height, 3);
  return std::all_of(inscatter.begin(), inscatter.end(), [](float value) { return value == 0; });
}

void FrameRenderer::noteEnclosures(host::Notes& notes) {
  const auto sum = [](const tyndall::Rgb& rgb) { return rgb[0] + rgb[1] + rgb[2]; };
  const auto scatters = [&](const tyndall::Constituent& constituent) { return sum(constituent.scattering) > 0; };
  const std::vector<tyndall::Constituent>& constituents = frame_.medium.constituents;
  if (std::none_of(constituents.begin(), constituents.end(), scatters)) return;
  for (const host::Enclosure& enclosure : host::enclosuresOf(scene(), drawer_->pose(), frame_.camera, frame_.lights)) {
    const tyndall::Light& light = frame_.lights[static_cast<std::size_t>(enclosure.light)];
    if (sum(light.colour) > 0 && light.scatteringScale > 0 && isKeptOut(light))
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
  host::Notes notes;
  const bool isFirst = drawer_->pose().empty();
  drawer_->draw(options_, momentOf(options_, frame), surfaces_, frame_, notes);
  resolveDepth();
  if (isFirst) noteEnclosures(notes);
  if (!options_.out.empty()) noteCutRadiance(notes);
  addOnce(notes_, notes);
  throwGlErrors();
}

Measurement FrameRenderer::render(int frame) {
  draw(frame);
  if (options_.checkInputs) renderEffect(frame_); // what it finds is known in the next
  Measurement measurement = measure();
  addOnce(notes_, measurement.statistics.warnings);
  if (drawer_->volumeShadows()) measurement.volumeShadows = drawer_->volumeShadows()->statistics();
  throwGlErrors();
  return measurement;
}

Picture FrameRenderer::readPicture() const {
  Picture picture;
  picture.composite = host::readColour(composite_.colour(), frame_.viewport.width, frame_.viewport.height);
  picture.inscatter = host::readColour(inscatter_.name(), frame_.viewport.width, frame_.viewport.height);
  picture.transmittance = host::readColour(transmittance_.name(), frame_.viewport.width, frame_.viewport.height);
  const host::RenderTargets& targets = surfaces_.multisampled() ? composite_ : surfaces_;
  picture.z =
      viewZ(host::readDepth(targets.depth(), targets.width(), targets.height()), frame_.camera, options_.reversedDepth);
  throwGlErrors();
  return picture;
}

} // namespace render
