#include "AllPrograms.h"
#include "EffectState.h"
#include "LoadFunctions.h"
#include "SampleBudget.h"
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
  if (Status s = loadFunctions(state->gl, config.loader, 33, {}); !s) return {nullptr, s};
  state->createObjects();
  if (Status s = state->watch.finish({}); !s) return {nullptr, s};
  return {std::unique_ptr<Effect>(new Effect(std::move(state))), {}};
}

namespace {

bool hasMeshes(const Frame& frame) {
  return std::any_of(frame.objects.begin(), frame.objects.end(),
                     [](const MovingObject& object) { return object.mesh.buffer != 0; });
}

} // namespace

Status Effect::render(const Frame& frame) {
  if (Status s = state_->checkContext("Effect::render"); !s) return s;
  return state_->watch.finish(state_->render(frame));
}

PrepareStatus Effect::prepare(const Frame&) { return {}; } // TEMPORARY: written on the branch of the frame's plan

Statistics Effect::statistics() {
  State& state = *state_;
  const std::uint64_t blocks = sizeof(blocks::FrameBlock) + sizeof(blocks::LightBlock) + sizeof(blocks::EpipolarBlock);
  if (state.redrawnShare < 0) state.redrawnShare = state.histories.of(state.lastView).redrawnShare();
  return {state.recorder.collect(),     state.targets.bytes() + state.histories.bytes() + blocks,
          state.programs.size(),        state.recorder.fixupPixels(),
          state.recorder.marched(),     state.redrawnShare,
          state.recorder.visitsPerRay()};
}

Status Effect::compileAll() {
  if (Status s = state_->checkContext("Effect::compileAll"); !s) return s;
  return state_->watch.finish(state_->compileAll());
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

Status Effect::State::checkContext(const char* function) {
  if (Status s = watch.check(); !s) return s;
  gl::Int marker = 0;
  if (gl.IsSampler(nearestSampler.name()))
    gl.GetSamplerParameteriv(nearestSampler.name(), gl::TEXTURE_MIN_LOD, &marker);
  if (!gl.IsVertexArray(vertexArray.name()) || marker != id)
    return {StatusCode::NoContext, "another GL context is current than the one the effect was created in"};
  return checkFeedback(gl, function);
}

Status Effect::State::compileAll() {
  const gl::StateGuard guard(gl);
  for (const gl::Variant& v : effectPrograms())
    if (!programs.use(v.fragment, v.definitions, v.vertex)) return shaderError();
  return {};
}

Status Effect::State::render(const Frame& frame) {
  if (Status s = checkValues(frame); !s) return s;
  const gl::StateGuard guard(gl);
  FrameTextures textures;
  if (Status s = checkTextures(gl, frame, textures); !s) return s;
  Frame boxed;
  if (hasMeshes(frame)) boxed = frame;
  if (frame.reuse.changes != Changes::Unknown) {
    ViewHistory& view = histories.of(frame.reuse.view);
    if (frame.reuse.changes == Changes::Detect || !view.isFollowedBy(frame)) view.lastShapes.clear();
    if (hasMeshes(frame))
      if (Status s = objectBoxes.makeBoxes(boxed, view.lastShapes); !s) return s;
  }
  recorder.beginFrame();
  redrawnShare = 1;
  Status status = renderChecked(hasMeshes(frame) ? boxed : frame, textures);
  targets.endFrame();
  return status;
}

Status Effect::State::renderChecked(const Frame& frame, const FrameTextures& textures) {
  const bool changesColour = optics::extinctionOf(frame.medium) != glm::dvec3(0);
  if (!changesColour) recorder.skip("composite", "the medium neither scatters nor absorbs");
  if (!changesColour && !hasView(frame) && frame.output.inscatter == 0 && frame.output.transmittance == 0) return {};

  if (frame.reuse.changes == Changes::Unknown) histories.forget(frame.reuse.view);
  if (frame.reuse.changes != Changes::Unknown && changesColour &&
      (!hasView(frame) || frame.settings.view == View::Redrawn)) {
    bool rests = false;
    Status status = renderReusing(frame, textures, rests);
    if (!rests) return status;
  }
  Destination destination;
  if (Status s = chooseDestination(frame, textures, changesColour, destination); !s) return s;
  if (destination.composite) // whatever refuses must do so before anything is drawn
    if (Status s = prepareColour(frame); !s) return s;
  beginDraws(frame, textures, destination);
  if (Status s = drawLights(frame, textures, destination); !s) return s;
  if (destination.copies)
    if (Status s = copyToOutput(frame, destination.inscatter, frame.output.inscatter); !s) return s;
  if (!destination.composite) return {};
  if (frame.settings.view == View::Redrawn)
    if (Status s = showRedrawn(frame, Redraw::All); !s) return s;
  if (hasView(frame)) return drawView(frame, textures, destination);

  return composite(frame, destination);
}

blocks::FrameBlock Effect::State::beginDraws(const Frame& frame, const FrameTextures& textures,
                                             const Destination& destination) {
  gl.BindVertexArray(vertexArray.name());
  gl.Viewport(0, 0, frame.width, frame.height);
  const blocks::FrameBlock block =
      optics::frameBlock(frame, {textures.depthSamples, destination.ceiling, textures.colourMax, textures.outputMax});
  upload(0, &block, sizeof block);
  return block;
}

Status Effect::State::composite(const Frame& frame, const Destination& destination) {
  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  const bool ok = recorder.run("composite", [&] {
    return passes::composite::run(passContext(), {destination.inscatter, destination.transmittance});
  });
  return ok ? Status{} : shaderError();
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

// True if the light may be capped though the sum of all is not: one of several adds more than its part of what the
// formats hold, so that they are to be added up in a texture of our own first.
bool sumIsCapped(const Frame& frame, float most, std::size_t lights) {
  if (lights < 2 || most >= kLargestFloat) return false;
  return std::any_of(frame.lights.begin(), frame.lights.end(), [&](const Light& light) {
    return optics::brightestInscatter(frame, light) > static_cast<double>(most) / static_cast<double>(lights);
  });
}

} // namespace

Status Effect::State::chooseDestination(const Frame& frame, const FrameTextures& textures, bool changesColour,
                                        Destination& destination) {
  const Output& output = frame.output;
  const bool curves = std::any_of(frame.lights.begin(), frame.lights.end(),
                                  [](const Light& light) { return light.curves.texture != 0; });
  const auto lights = static_cast<std::size_t>(std::count_if(
      frame.lights.begin(), frame.lights.end(), [&](const Light& l) { return reasonToSkip(frame, l, true).empty(); }));
  const float most =
      output.inscatter ? textures.outputMax : textures.colourMax; // of the format that they are added up in
  const bool apart = sumIsCapped(frame, most, lights);
  destination.ceiling = most / static_cast<float>(std::max<std::size_t>(lights, 1));
  // Shaders for smoke and hair are many and long: there are none that blend into the colour at once.
  if (output.inscatter == 0 && output.transmittance == 0 && !hasView(frame) && !curves && !apart) return {};
  destination.inscatter = apart ? 0 : output.inscatter;
  destination.transmittance = output.transmittance;
  destination.composite = hasView(frame) || (changesColour && frame.colour != 0);
  destination.copies = apart && output.inscatter != 0;
  const bool needsInscatter = destination.composite || destination.copies;
  if (!destination.inscatter && needsInscatter) {
    destination.inscatter = targets.get(Target::Inscatter, frame.width, frame.height);
    destination.ceiling = kLargestFloat / static_cast<float>(std::max<std::size_t>(lights, 1));
  }
  if (!destination.transmittance && destination.composite)
    destination.transmittance = targets.get(Target::Transmittance, frame.width, frame.height);
  if ((destination.inscatter || !needsInscatter) && (destination.transmittance || !destination.composite)) return {};
  return {StatusCode::OutOfMemory,
          "GL could not allocate a texture of " + std::to_string(frame.width) + " x " + std::to_string(frame.height)};
}

Status Effect::State::prepareColour(const Frame& frame) {
  if (Status s = attach(frame, frame.colour, 0); !s) return s;
  const bool ok = hasView(frame) ? passes::view::prepare(passContext(), frame.settings.view)
                                 : programs.use("passes/composite.frag", {}) != 0;
  if (!ok) return shaderError();
  return showsSlices(frame) ? clearView(frame, 0) : Status{};
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
  variant.curves = light->curves.texture != 0;
  variant.bilinear = frame.settings.shadowFilter == ShadowFilter::Bilinear;
  return variant;
}

std::string nameOf(const Frame& frame, std::size_t light) {
  const bool exact = frame.settings.technique == Technique::Exact || frame.depth.multisampled;
  return (exact ? "exact light " : "light ") + std::to_string(light);
}

} // namespace

std::vector<Effect::State::DrawnLight> Effect::State::lightsToDraw(const Frame& frame, const FrameTextures& textures,
                                                                   bool wantsInscatter, bool direct) {
  std::vector<bool> drawn;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const std::string reason = reasonToSkip(frame, frame.lights[i], wantsInscatter);
    drawn.push_back(reason.empty());
    if (!reason.empty()) recorder.skip(nameOf(frame, i), reason);
  }
  const std::vector<Settings> settings = dealSamples(frame, drawn);
  std::vector<DrawnLight> lights;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const Light& light = frame.lights[i];
    const FrameTextures::Shadow& map = textures.shadows[i];
    if (drawn[i])
      lights.push_back({i, nameOf(frame, i), settings[i],
                        optics::lightBlock(frame, light, map.width, map.height, map.curvesSize),
                        variantOf(frame, &light, direct)});
  }
  return lights;
}

Status Effect::State::drawLights(const Frame& frame, const FrameTextures& textures, const Destination& destination) {
  const bool direct = destination.direct();
  const std::vector<DrawnLight> lights = lightsToDraw(frame, textures, direct || destination.inscatter != 0, direct);
  Frame lit = frame; // for one light at a time
  for (const DrawnLight& light : lights) {
    const bool first = &light == &lights.front();
    lit.settings = light.settings;
    upload(1, &light.block, sizeof light.block);
    if (!usesSlices(frame)) {
      if (Status s = drawExact(lit, light, destination, first); !s) return s;
      continue;
    }
    const passes::SliceInputs in = sliceInputs(lit, light, textures, destination, first);
    if (Status s = passes::epipolar::run(passContext(), targets, recorder, scratch, in); !s) return s;
  }
  if (!lights.empty()) return {};
  return drawExact(frame, {frame.lights.size(), "transmittance", {}, {}, variantOf(frame, nullptr, direct)},
                   destination, true);
}

passes::SliceInputs Effect::State::sliceInputs(const Frame& lit, const DrawnLight& light, const FrameTextures& textures,
                                               const Destination& destination, bool first) {
  // The frame's first draw also brings the transmittance; those after it add their light.
  const auto attachDestination = [this, &lit, &destination, first](bool withStencil, bool withTransmittance) {
    return destination.direct() ? attach(lit, lit.colour, 0, withStencil)
                                : attach(lit, destination.inscatter,
                                         first && withTransmittance ? destination.transmittance : 0, withStencil);
  };
  const auto uploadBlock = [this](int binding, const void* data, std::size_t size) { upload(binding, data, size); };
  std::function<Status(bool)> attachView;
  if (first && showsSlices(lit))
    attachView = [this, &lit](bool withStencil) {
      return attach(lit, targets.get(Target::View, lit.width, lit.height), 0, withStencil);
    };
  using passes::Blend;
  const Blend blend = !first ? Blend::Add : destination.direct() ? Blend::DualSource : Blend::Replace;
  return {&lit,
          &lit.lights[light.index],
          textures.shadows[light.index],
          light.variant,
          blend,
          light.name,
          attachDestination,
          attachView,
          uploadBlock};
}

// Also the transmittance alone, of a light with the index past the last.
Status Effect::State::drawExact(const Frame& frame, const DrawnLight& light, const Destination& destination,
                                bool first) {
  const bool direct = destination.direct();
  if (Status s = direct ? attach(frame, frame.colour, 0)
                        : attach(frame, destination.inscatter, first ? destination.transmittance : 0);
      !s)
    return s;
  const Light* source = light.index < frame.lights.size() ? &frame.lights[light.index] : nullptr;
  using passes::Blend;
  const Blend blend = !first ? Blend::Add : direct ? Blend::DualSource : Blend::Replace;
  const passes::exact::In in{light.variant, frame.depth.texture, source, blend};
  if (source) recorder.countMarched(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
  return recorder.run(light.name, [&] { return passes::exact::run(passContext(), in); }) ? Status{} : shaderError();
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
