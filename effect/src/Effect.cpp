#include "CheckFrame.h"
#include "PassRecorder.h"
#include "SampleBudget.h"
#include "Targets.h"
#include "gl/Program.h"
#include "gl/StateGuard.h"
#include "optics/Blocks.h"
#include "optics/LightVolume.h"
#include "passes/Composite.h"
#include "passes/Epipolar.h"
#include "passes/Exact.h"
#include "passes/View.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

// The data flow of a frame. Boxes are passes (effect/src/passes, glsl/passes), the rest are textures.
//
//   Technique exact, one draw per light:
//
//   scene depth --+
//   shadow map ---+--> [exact] one draw per light --+--> blended into colour            (no Output asked for)
//   glass map ----+                                 |
//                                                   +--> inscatter, transmittance --> [composite] --> colour
//
//   A debug view (Settings::view) takes the place of [composite]:
//
//   inscatter, transmittance, or what passes/SliceView.cpp drew of the first light --> [view] --> colour
//
//   Techniques tree, lowrank and epipolar, per light, take the place of [exact]: passes/Epipolar.cpp has their picture.
//
namespace tyndall {

static_assert(gl::kTextureUnits == static_cast<int>(gl::Unit::Upload) + 1, "the guard restores every unit of ours");

struct Effect::State {
  explicit State(const Config& config) : programs(gl), targets(gl), recorder(gl, config.timing) {}

  gl::Functions gl;
  gl::ProgramCache programs;
  Targets targets;
  PassRecorder recorder;
  gl::VertexArray vertexArray;
  gl::Framebuffer framebuffer;
  gl::Framebuffer scratch; // for the targets of slices
  gl::Int id = 0;          ///< kept in our sampler, where it tells this context from another with the same names
  gl::Sampler nearestSampler;
  std::array<gl::Buffer, gl::kUniformBindings> uniformBuffers;

  // Where a frame's light goes: straight into colour, or into two textures first.
  struct Destination {
    gl::Uint inscatter = 0, transmittance = 0; // 0, 0: straight into colour
    bool composite = false;                    // blend them, or show the view, into colour afterwards
    bool direct() const { return inscatter == 0 && transmittance == 0; }
  };

  void createObjects();
  Status checkContext() const;
  Status renderChecked(const Frame& frame, const FrameTextures& textures);
  Status chooseDestination(const Frame& frame, bool changesColour, Destination& destination);
  Status attach(const Frame& frame, gl::Uint first, gl::Uint second, bool withStencil = false);
  Status drawLights(const Frame& frame, const FrameTextures& textures, const Destination& destination);
  Status prepareColour(const Frame& frame);
  Status drawView(const Frame& frame, const FrameTextures& textures, const Destination& destination);
  Status drawDifference(const Frame& frame, const FrameTextures& textures, passes::view::In& in);
  Status drawMean(const Frame& frame, gl::Uint image, int channels, gl::Uint& mean);
  Status readVisits(const Frame& frame, gl::Uint image);
  Status clearView(const Frame& frame);
  Status drawLight(const Frame& frame, const Light* light, const FrameTextures::Shadow& map,
                   const Destination& destination, bool first, const std::string& name);
  // Slices take one depth per pixel: a multisampled frame is rendered by exact.
  static bool usesSlices(const Frame& frame) {
    return frame.settings.technique != Technique::Exact && !frame.depth.multisampled;
  }
  static bool hasView(const Frame& frame) { return frame.settings.view != View::Composite; }
  static bool showsSlices(const Frame& frame) {
    return frame.settings.view >= View::Slices && frame.settings.view <= View::NodeVisits;
  }
  void upload(int binding, const void* data, std::size_t size);
  passes::PassContext passContext() { return {gl, programs, nearestSampler.name()}; }
  Status shaderError() const { return {StatusCode::ShaderError, "a shader did not build: " + programs.error()}; }
};

// ---------------------------------------------------------------------------------------------------------------------

Effect::Effect(std::unique_ptr<State> state) : state_(std::move(state)) {}
Effect::~Effect() = default;

CreateResult Effect::create(const Config& config) {
  if (!config.loader)
    return {nullptr,
            {StatusCode::InvalidConfig, "Config::loader is null: a function that resolves GL names is needed"}};
  if (config.timing < PassTiming::Off || config.timing > PassTiming::Finish)
    return {nullptr,
            {StatusCode::InvalidConfig, "Config::timing is " + std::to_string(static_cast<int>(config.timing)) +
                                            ": must be one of the enumerators"}};
  auto state = std::make_unique<State>(config);
  gl::Functions& gl = state->gl;
  const std::string missing = gl.load(config.loader);
  if (!gl.GetString || !gl.GetString(gl::VERSION))
    return {nullptr, {StatusCode::NoContext, "no GL context is current on this thread"}};
  const std::string version = reinterpret_cast<const char*>(gl.GetString(gl::VERSION));
  if (!gl.GetIntegerv) return {nullptr, {StatusCode::ContextTooOld, "the loader knows no " + missing}};
  gl::Int major = 0, minor = 0;
  gl.GetIntegerv(gl::MAJOR_VERSION, &major); // an error, and 0, before OpenGL 3.0
  gl.GetIntegerv(gl::MINOR_VERSION, &minor);
  gl.version = 10 * major + minor;
  if (gl.version < 33 || version.rfind("OpenGL ES", 0) == 0)
    return {nullptr,
            {StatusCode::ContextTooOld, "the context is \"" + version + "\": OpenGL 3.3 core or later is needed"}};
  if (!missing.empty())
    return {nullptr,
            {StatusCode::ContextTooOld, "the context is \"" + version + "\" but the loader knows no " + missing}};
  state->createObjects();
  return {std::unique_ptr<Effect>(new Effect(std::move(state))), {}};
}

Status Effect::render(const Frame& frame) {
  State& state = *state_;
  if (Status s = state.checkContext(); !s) return s;
  if (Status s = checkValues(frame); !s) return s;
  const gl::StateGuard guard(state.gl);
  FrameTextures textures;
  if (Status s = checkTextures(state.gl, frame, textures); !s) return s;
  state.recorder.beginFrame();
  Status status = state.renderChecked(frame, textures);
  state.targets.endFrame();
  return status;
}

Statistics Effect::statistics() {
  std::uint64_t bytes = state_->targets.bytes() + sizeof(blocks::FrameBlock) + sizeof(blocks::LightBlock);
  return {state_->recorder.collect(), bytes,
          state_->programs.size(),    state_->recorder.fixupPixels(),
          state_->recorder.marched(), state_->recorder.visitsPerRay()};
}

Status Effect::compileAll() {
  if (Status s = state_->checkContext(); !s) return s;
  const gl::StateGuard guard(state_->gl);
  for (const passes::exact::Variant& variant : passes::exact::allVariants())
    if (!state_->programs.use("passes/exact.frag", passes::exact::definitionsOf(variant))) return state_->shaderError();
  for (const auto& variants : {passes::epipolar::allVariants(), passes::view::allVariants()})
    for (const gl::Variant& v : variants)
      if (!state_->programs.use(v.fragment, v.definitions, v.vertex)) return state_->shaderError();
  if (!state_->programs.use("passes/composite.frag", {})) return state_->shaderError();
  return {};
}

// ---------------------------------------------------------------------------------------------------------------------

void Effect::State::createObjects() {
  const gl::StateGuard guard(gl);
  vertexArray = gl::VertexArray(gl);
  gl.BindVertexArray(vertexArray.name()); // a name becomes an object when it is first bound
  framebuffer = gl::Framebuffer(gl);
  scratch = gl::Framebuffer(gl);
  nearestSampler = gl::Sampler(gl);
  for (const gl::Enum filter : {gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER})
    gl.SamplerParameteri(nearestSampler.name(), filter, gl::NEAREST);
  for (const gl::Enum wrap : {gl::TEXTURE_WRAP_S, gl::TEXTURE_WRAP_T})
    gl.SamplerParameteri(nearestSampler.name(), wrap, gl::CLAMP_TO_EDGE);
  gl.SamplerParameteri(nearestSampler.name(), gl::TEXTURE_COMPARE_MODE, gl::NONE);
  static std::atomic<int> count{0};
  id = -1000 - ++count % 1000000; // exact in a float, and of no effect: our shaders fetch texels
  gl.SamplerParameteri(nearestSampler.name(), gl::TEXTURE_MIN_LOD, id);
  for (gl::Buffer& buffer : uniformBuffers)
    buffer = gl::Buffer(gl);
}

Status Effect::State::checkContext() const {
  if (!gl.GetString(gl::VERSION)) return {StatusCode::NoContext, "no GL context is current on this thread"};
  gl::Int marker = 0;
  if (gl.IsSampler(nearestSampler.name()))
    gl.GetSamplerParameteriv(nearestSampler.name(), gl::TEXTURE_MIN_LOD, &marker);
  if (!gl.IsVertexArray(vertexArray.name()) || marker != id)
    return {StatusCode::NoContext, "another GL context is current than the one the effect was created in"};
  gl::Int feedback = 0;
  if (gl.version >= 40) gl.GetIntegerv(gl::TRANSFORM_FEEDBACK_ACTIVE, &feedback);
  if (feedback) return {StatusCode::InvalidFrame, "transform feedback is active: end it before Effect::render"};
  return {};
}

Status Effect::State::renderChecked(const Frame& frame, const FrameTextures& textures) {
  const bool changesColour = optics::extinctionOf(frame.medium) != glm::dvec3(0);
  if (!changesColour) recorder.skip("composite", "the medium neither scatters nor absorbs");
  if (!changesColour && !hasView(frame) && frame.output.inscatter == 0 && frame.output.transmittance == 0) return {};

  Destination destination;
  if (Status s = chooseDestination(frame, changesColour, destination); !s) return s;
  if (destination.composite) // whatever refuses must do so before anything is drawn
    if (Status s = prepareColour(frame); !s) return s;
  gl.BindVertexArray(vertexArray.name());
  gl.Viewport(0, 0, frame.width, frame.height);
  const auto lights = static_cast<float>(std::max<std::size_t>(frame.lights.size(), 1));
  const blocks::FrameBlock block = optics::frameBlock(frame, {textures.depthSamples, textures.maxRadiance / lights});
  upload(0, &block, sizeof block);
  if (Status s = drawLights(frame, textures, destination); !s) return s;
  if (!destination.composite) return {};
  if (hasView(frame)) return drawView(frame, textures, destination);

  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  const bool ok = recorder.run("composite", [&] {
    return passes::composite::run(passContext(), {destination.inscatter, destination.transmittance});
  });
  return ok ? Status{} : shaderError();
}

Status Effect::State::chooseDestination(const Frame& frame, bool changesColour, Destination& destination) {
  const Output& output = frame.output;
  if (output.inscatter == 0 && output.transmittance == 0 && !hasView(frame)) return {};
  destination = {output.inscatter, output.transmittance, hasView(frame) || (changesColour && frame.colour != 0)};
  if (!destination.composite) return {};
  if (!destination.inscatter) destination.inscatter = targets.get(Target::Inscatter, frame.width, frame.height);
  if (!destination.transmittance)
    destination.transmittance = targets.get(Target::Transmittance, frame.width, frame.height);
  if (destination.inscatter && destination.transmittance) return {};
  return {StatusCode::OutOfMemory,
          "GL could not allocate a texture of " + std::to_string(frame.width) + " x " + std::to_string(frame.height)};
}

Status Effect::State::prepareColour(const Frame& frame) {
  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  const bool ok = hasView(frame) ? passes::view::prepare(passContext(), frame.settings.view)
                                 : programs.use("passes/composite.frag", {}) != 0;
  if (!ok) return shaderError();
  return showsSlices(frame) ? clearView(frame) : Status{};
}

// Black, where no light is drawn or a sample lies.
Status Effect::State::clearView(const Frame& frame) {
  const gl::Uint view = targets.get(Target::View, frame.width, frame.height);
  if (!view) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = attach(frame, view, 0); !s) return s;
  constexpr std::array<gl::Float, 4> kBlack = {0, 0, 0, 0};
  gl.ClearBufferfv(gl::COLOR, 0, kBlack.data());
  return {};
}

Status Effect::State::drawView(const Frame& frame, const FrameTextures& textures, const Destination& destination) {
  passes::view::In in{frame.settings.view, destination.inscatter};
  if (in.view == View::Transmittance) in.image = destination.transmittance;
  if (showsSlices(frame)) in.image = targets.get(Target::View, frame.width, frame.height);
  if (in.view == View::Difference)
    if (Status s = drawDifference(frame, textures, in); !s) return s;
  if (in.view == View::NodeVisits)
    if (Status s = readVisits(frame, in.image); !s) return s;
  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  return recorder.run("view", [&] { return passes::view::run(passContext(), in); }) ? Status{} : shaderError();
}

// Exact's inscatter, and its mean.
Status Effect::State::drawDifference(const Frame& frame, const FrameTextures& textures, passes::view::In& in) {
  Frame exactFrame = frame;
  exactFrame.settings.technique = Technique::Exact;
  in.exact = targets.get(Target::ViewExact, frame.width, frame.height);
  if (!in.exact) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = drawLights(exactFrame, textures, {in.exact, 0, true}); !s) return s;
  return drawMean(frame, in.exact, 3, in.mean);
}

Status Effect::State::drawMean(const Frame& frame, gl::Uint image, int channels, gl::Uint& mean) {
  mean = targets.get(Target::ViewMean, 1, 1);
  const gl::Uint rowMeans = targets.get(Target::ViewRowMeans, frame.height, 1);
  if (!mean || !rowMeans) return {StatusCode::OutOfMemory, "GL could not allocate a texture for Frame::settings.view"};
  if (Status s = attach(frame, image, 0); !s) return s; // without a second target and a stencil
  const passes::view::MeanIn in{image, channels, frame.height, rowMeans, mean};
  return recorder.run("view mean", [&] { return passes::view::runMean(passContext(), in); }) ? Status{} : shaderError();
}

// Waits for the GPU, which a view to look at may.
Status Effect::State::readVisits(const Frame& frame, gl::Uint image) {
  gl::Uint mean = 0;
  if (Status s = drawMean(frame, image, 1, mean); !s) return s;
  gl::Float visits = 0;
  passes::bindTexture(passContext(), gl::Unit::ViewMean, gl::TEXTURE_2D, mean);
  gl.GetTexImage(gl::TEXTURE_2D, 0, gl::RED, gl::FLOAT, &visits);
  recorder.countVisits(visits);
  return {};
}

Status Effect::State::attach(const Frame& frame, gl::Uint first, gl::Uint second, bool withStencil) {
  gl.BindFramebuffer(gl::DRAW_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, first, 0);
  gl.FramebufferTexture2D(gl::DRAW_FRAMEBUFFER, gl::COLOR_ATTACHMENT0 + 1, gl::TEXTURE_2D, second, 0);
  const gl::Uint stencil = withStencil ? targets.stencil(frame.width, frame.height) : 0;
  if (withStencil && !stencil) return {StatusCode::OutOfMemory, "GL could not allocate a stencil buffer"};
  gl.FramebufferRenderbuffer(gl::DRAW_FRAMEBUFFER, gl::STENCIL_ATTACHMENT, gl::RENDERBUFFER, stencil);
  gl.Viewport(0, 0, frame.width, frame.height);
  const std::array<gl::Enum, 2> buffers = {first ? gl::COLOR_ATTACHMENT0 : gl::NONE,
                                           second ? gl::COLOR_ATTACHMENT0 + 1 : gl::NONE};
  gl.DrawBuffers(second ? 2 : 1, buffers.data());
  if (gl.CheckFramebufferStatus(gl::DRAW_FRAMEBUFFER) == gl::FRAMEBUFFER_COMPLETE) return {};
  return {StatusCode::InvalidFrame, std::string("Frame::") + (first == frame.colour ? "colour" : "output") +
                                        ": this context cannot render to the texture's format"};
}

namespace {

// Why a light has nothing to add; empty if it has.
std::string reasonToSkip(const Frame& frame, const Light& light, bool wantsInscatter) {
  if (light.colour == Rgb{0, 0, 0}) return "the light is black";
  if (optics::scatteringOf(frame.medium) == glm::dvec3(0)) return "the medium does not scatter";
  if (!wantsInscatter) return "only the transmittance is wanted";
  if (optics::isOutOfView(light, frame.camera)) return "the light's volume is outside the view";
  return {};
}

// The shader variant of a light; null: transmittance only.
passes::exact::Variant variantOf(const Frame& frame, const Light* light, bool direct) {
  passes::exact::Variant variant;
  variant.monochrome = optics::isMonochrome(frame.medium);
  variant.multisampled = frame.depth.multisampled;
  variant.composite = direct;
  if (!light) return variant;
  variant.lightKind = static_cast<int>(light->kind);
  variant.glass = light->glass.colour != 0;
  if (light->shadow.texture == 0) return variant;
  variant.shadowViews = light->shadow.views.size() > 1 ? 2 : 1;
  variant.shadowArray = light->shadow.array;
  variant.bilinear = frame.settings.shadowFilter == ShadowFilter::Bilinear;
  return variant;
}

} // namespace

Status Effect::State::drawLights(const Frame& frame, const FrameTextures& textures, const Destination& destination) {
  std::vector<std::string> reasons; // to skip a light
  std::vector<bool> drawn;
  for (const Light& light : frame.lights) {
    reasons.push_back(reasonToSkip(frame, light, destination.direct() || destination.inscatter != 0));
    drawn.push_back(reasons.back().empty());
  }
  const std::vector<Settings> settings = dealSamples(frame, drawn);
  Frame lit = frame; // for one light at a time
  bool first = true;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const Light& light = frame.lights[i];
    const std::string name = (usesSlices(frame) ? "light " : "exact light ") + std::to_string(i);
    if (!drawn[i]) {
      recorder.skip(name, reasons[i]);
      continue;
    }
    lit.settings = settings[i];
    const FrameTextures::Shadow& map = textures.shadows[i];
    const blocks::LightBlock block = optics::lightBlock(light, frame.camera, map.width, map.height);
    upload(1, &block, sizeof block);
    if (Status s = drawLight(lit, &light, map, destination, first, name); !s) return s;
    first = false;
  }
  return first ? drawLight(frame, nullptr, {}, destination, true, "transmittance") : Status{};
}

Status Effect::State::drawLight(const Frame& frame, const Light* light, const FrameTextures::Shadow& map,
                                const Destination& destination, bool first, const std::string& name) {
  using namespace passes;
  // The frame's first draw also brings the transmittance; those after it add their light.
  const auto attachDestination = [&](bool withStencil, bool withTransmittance) {
    return destination.direct() ? attach(frame, frame.colour, 0, withStencil)
                                : attach(frame, destination.inscatter,
                                         first && withTransmittance ? destination.transmittance : 0, withStencil);
  };
  const exact::Variant variant = variantOf(frame, light, destination.direct());
  const Blend blend = !first ? Blend::Add : destination.direct() ? Blend::DualSource : Blend::Replace;
  if (light && usesSlices(frame)) {
    const auto uploadBlock = [this](int binding, const void* data, std::size_t size) { upload(binding, data, size); };
    std::function<Status(bool)> attachView;
    if (first && showsSlices(frame))
      attachView = [&](bool withStencil) {
        return attach(frame, targets.get(Target::View, frame.width, frame.height), 0, withStencil);
      };
    const SliceInputs in{&frame, light, map, variant, blend, name, attachDestination, attachView, uploadBlock};
    return epipolar::run(passContext(), targets, recorder, scratch, in);
  }
  if (Status s = attachDestination(false, true); !s) return s;
  const exact::In in{variant, frame.depth.texture, light, blend};
  if (light) recorder.countMarched(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
  return recorder.run(name, [&] { return exact::run(passContext(), in); }) ? Status{} : shaderError();
}

void Effect::State::upload(int binding, const void* data, std::size_t size) {
  const gl::Uint name = uniformBuffers[static_cast<std::size_t>(binding)].name();
  gl.BindBuffer(gl::UNIFORM_BUFFER, name);
  gl.BufferData(gl::UNIFORM_BUFFER, static_cast<gl::Sizeiptr>(size), data, gl::STREAM_DRAW);
  gl.BindBufferBase(gl::UNIFORM_BUFFER, static_cast<gl::Uint>(binding), name);
}

// ---------------------------------------------------------------------------------------------------------------------

Mat4 mat4(const float* columnMajor) {
  Mat4 m{};
  std::copy(columnMajor, columnMajor + 16, m.begin());
  return m;
}

} // namespace tyndall
