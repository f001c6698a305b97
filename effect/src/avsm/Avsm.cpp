#include "tyndall/avsm.h"

#include "ContextWatch.h"
#include "LoadFunctions.h"
#include "PassRecorder.h"
#include "Rounding.h"
#include "avsm/CheckAvsm.h"
#include "avsm/Curves.h"
#include "avsm/Lists.h"
#include "avsm/Particles.h"
#include "avsm/StorageGuard.h"
#include "avsm/Volumes.h"
#include "gl/OwnErrors.h"
#include "gl/ProgramCache.h"
#include "gl/ShaderSources.h"
#include "gl/StateGuard.h"

#include <algorithm>
#include <utility>

// A frame's curves (Salvi et al. 2013). Boxes are passes:
//
//   the engine's shaders, avsmCapture.glsl --> lists of segments
//   lists --> [avsmSort] --> lists in the order of entries --> [avsmSort, exits] --> and of exits
//   Fitted, InOrder:  lists --> [avsmInsert] --> curves
//   Sorted:           lists in the order of entries --> [avsmInsert] --> curves
//   WholeCurve:       lists in both orders --> [avsmReduce] --> curves
//
// Or as segments come:
//
//   [avsmEmpty] --> curves --> [avsmParticles] or the engine's shaders, avsmInsert.glsl --> curves
//
// Volumes, into either:
//
//   density --> [avsmRanges], a level at a time, unless it is as it was --> ranges
//   density, ranges --> [avsmVolumes], for each view that sees it --> lists, or curves
//
namespace tyndall {

namespace {

// A dispatch over the map.
struct Pass {
  const char* name;
  const char* file;
  gl::Definitions definitions;
};

// From lists to curves; to reduce whole curves in the order of exits as well.
std::vector<Pass> passesOf(const AvsmConfig& config) {
  std::vector<Pass> passes;
  if (config.reduction == CurveReduction::WholeCurve || config.reduction == CurveReduction::Sorted)
    passes.push_back({"sort entries", "passes/avsmSort.comp", {{"EXITS", 0}}});
  if (config.reduction == CurveReduction::WholeCurve) {
    passes.push_back({"sort exits", "passes/avsmSort.comp", {{"EXITS", 1}}});
    passes.push_back({"reduce", "passes/avsmReduce.comp", avsm::curveDefinitions(config.nodes, config.packed)});
  } else {
    const bool spare = config.reduction == CurveReduction::Fitted;
    passes.push_back({"insert", "passes/avsmInsert.comp", avsm::insertDefinitions(config.nodes, config.packed, spare)});
  }
  return passes;
}

constexpr int kGroup = 8; // texels across and up a work group (lib/avsm.glsl)

// Whatever may use curves, or lists, next.
constexpr gl::Bitfield kBarriers = gl::SHADER_STORAGE_BARRIER_BIT | gl::TEXTURE_FETCH_BARRIER_BIT |
                                   gl::TEXTURE_UPDATE_BARRIER_BIT | gl::SHADER_IMAGE_ACCESS_BARRIER_BIT |
                                   gl::FRAMEBUFFER_BARRIER_BIT;

} // namespace

struct Avsm::State {
  explicit State(const AvsmConfig& c) : config(c), watch(gl), programs(gl, c.programs), recorder(gl, c.timing) {}

  AvsmConfig config;
  gl::Functions gl;
  ContextWatch watch;
  gl::ProgramCache programs;
  PassRecorder recorder;
  std::unique_ptr<avsm::Lists> lists;
  gl::Texture curves;
  gl::Buffer particlesBlock;
  avsm::Volumes volumes{gl};
  gl::Framebuffer framebuffer; // of a layer's curves, once asked for
  std::uint64_t version = 0;
  enum class Began { Nothing, Capture, Streaming } began = Began::Nothing;
  std::uint32_t firstBinding = 0; // of lists, while capturing
  bool recording = false;         // passes since begin()
  bool streamed = false;          // what was resolved last
  bool mayBeEmpty = true;         // the newest frame that is known was, or none is known
  bool holds = false;             // the curves may hold anything

  Status checkContext(const char* function);
  Status begin(std::uint32_t binding);
  Status resolve();
  Status beginStreaming();
  Status drawParticles(const Light& light, const AvsmParticles& particles);
  Status drawVolumes(const Light& light, const std::vector<AvsmVolume>& volumes);
  Status bindCurves(int layer);
  void bindListsAgain();
  void record();
  void makeCurves();
  Status makeObjects();
  Status allocate();
  Status checkStreaming(const char* function) const;
  Status build(const Pass& pass);
  Status attachCurves(int layer);
  using Uniforms = std::vector<std::pair<const char*, gl::Int>>;
  void run(const Pass& pass, const Uniforms& uniforms, const avsm::Groups& groups);
  void runOverMap(const Pass& pass, const Uniforms& uniforms = {}, int layers = 0);
  void insertParticles(const AvsmParticles& particles, int views);
  Pass emptyPass() const { return {"empty", "passes/avsmEmpty.comp", {}}; }
  Pass volumesPass() const {
    return {"volumes", "passes/avsmVolumes.comp",
            avsm::volumeDefinitions(config.nodes, config.packed, began == Began::Streaming)};
  }
  Pass rangesPass(bool finest) const { return {"ranges", "passes/avsmRanges.comp", {{"FINEST", finest ? 1 : 0}}}; }
  Pass particlesPass() const { return {"particles", "passes/avsmParticles.comp", curveDefinitions()}; }
  std::uint64_t curveBytes() const {
    return std::uint64_t{16} * static_cast<std::uint64_t>(config.size) * static_cast<std::uint64_t>(config.size) *
           static_cast<std::uint64_t>(avsm::curveLayersOf(config));
  }
  gl::Definitions curveDefinitions() const { return avsm::curveDefinitions(config.nodes, config.packed); }
};

Avsm::Avsm(std::unique_ptr<State> state) : state_(std::move(state)) {}
Avsm::~Avsm() = default;

AvsmResult Avsm::create(const AvsmConfig& config) {
  if (Status s = avsm::checkConfig(config); !s) return {nullptr, s};
  auto state = std::make_unique<State>(config);
  const gl::Functions& gl = state->gl;
  if (Status s = loadFunctions(state->gl, config.loader, 43, " for an adaptive volumetric shadow map"); !s)
    return {nullptr, s};
  if (const std::string function = avsm::missingFunction(gl); !function.empty())
    return {nullptr, {StatusCode::ContextTooOld, "the loader knows no " + function}};
  if (Status s = avsm::checkLimits(gl, config); !s) return {nullptr, s};
  if (Status s = checkLists(gl, "Avsm::create"); !s) return {nullptr, s};
  if (Status s = state->watch.finish(state->makeObjects()); !s) return {nullptr, s};
  return {std::unique_ptr<Avsm>(new Avsm(std::move(state))), {}};
}

Status Avsm::begin(std::uint32_t firstBinding) {
  if (Status s = state_->watch.check(); !s) return s;
  return state_->watch.finish(state_->begin(firstBinding));
}

Status Avsm::resolve() {
  if (Status s = state_->checkContext("Avsm::resolve"); !s) return s;
  return state_->watch.finish(state_->resolve());
}

Status Avsm::beginStreaming() {
  if (Status s = state_->checkContext("Avsm::beginStreaming"); !s) return s;
  return state_->watch.finish(state_->beginStreaming());
}

Status Avsm::drawParticles(const Light& light, const AvsmParticles& particles) {
  if (Status s = state_->checkContext("Avsm::drawParticles"); !s) return s;
  return state_->watch.finish(state_->drawParticles(light, particles));
}

Status Avsm::drawVolumes(const Light& light, const std::vector<AvsmVolume>& volumes) {
  if (Status s = state_->checkContext("Avsm::drawVolumes"); !s) return s;
  const Status status = state_->drawVolumes(light, volumes);
  state_->bindListsAgain();
  return state_->watch.finish(status);
}

Status Avsm::bindCurves(int layer) {
  if (Status s = state_->watch.check(); !s) return s;
  return state_->watch.finish(state_->bindCurves(layer));
}

AvsmCurves Avsm::curves() const {
  const State& state = *state_;
  return {state.holds ? state.curves.name() : 0, state.config.nodes, state.config.packed, state.version};
}

AvsmStatistics Avsm::statistics() {
  State& state = *state_;
  const avsm::BufferGuard guard(state.gl, state.config.state);
  const avsm::ListsHeader header = state.version > 0 && !state.streamed ? state.lists->wait() : avsm::ListsHeader{};
  return {state.recorder.collect(), header.captured(), header.lost, state.lists->bytes(), state.curveBytes()};
}

// ---------------------------------------------------------------------------------------------------------------------

Status Avsm::State::begin(std::uint32_t binding) {
  gl::Int bindings = 0;
  gl.GetIntegerv(gl::MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
  if (bindings < 2 || binding > static_cast<std::uint32_t>(bindings) - 2)
    return {StatusCode::InvalidConfig, "firstBinding is " + std::to_string(binding) +
                                           ": this and the next must be below this context's " +
                                           std::to_string(bindings) + " storage buffer bindings"};
  const avsm::BufferGuard guard(gl, config.state);
  if (lists->receive()) mayBeEmpty = lists->known().firsts == 0;
  if (Status s = lists->makeRoom(); !s) return s;
  gl.MemoryBarrier(gl::BUFFER_UPDATE_BARRIER_BIT); // shaders wrote what is emptied
  lists->empty();
  volumes.beginFrame();
  lists->bind(binding, false);
  firstBinding = binding;
  began = State::Began::Capture;
  recording = false;
  return {};
}

Status Avsm::State::resolve() {
  if (began == State::Began::Nothing)
    return {StatusCode::InvalidFrame, "Avsm::resolve needs a begin() or beginStreaming() before it"};
  if (began == State::Began::Streaming) {
    gl.MemoryBarrier(kBarriers);
    streamed = true;
    began = State::Began::Nothing;
    ++version;
    return {};
  }
  const gl::StateGuard guard(gl, config.state);
  const avsm::StorageGuard storageGuard(gl, config.state);
  for (const Pass& pass : passesOf(config))
    if (Status s = build(pass); !s) return s;
  streamed = false;
  began = State::Began::Nothing;
  ++version;
  record();
  gl.MemoryBarrier(gl::SHADER_STORAGE_BARRIER_BIT | gl::BUFFER_UPDATE_BARRIER_BIT);
  lists->send();
  // Scenes without smoke pay a wait instead of passes; the others do not wait.
  if (mayBeEmpty) mayBeEmpty = lists->wait().firsts == 0;
  holds = !mayBeEmpty;
  if (holds)
    makeCurves();
  else
    recorder.skip("curves", "no segment was captured");
  return {};
}

Status Avsm::State::beginStreaming() {
  const gl::StateGuard guard(gl, config.state);
  const avsm::StorageGuard storageGuard(gl, config.state);
  if (Status s = build(emptyPass()); !s) return s;
  recorder.beginFrame();
  gl.BindImageTexture(0, curves.name(), 0, 1, 0, gl::WRITE_ONLY, gl::RGBA32UI);
  constexpr gl::Int kPackedOne = -1, kOne = 0x3F800000; // depth and transmittance 1, in bits
  runOverMap(emptyPass(), {{"clearWord", config.packed ? kPackedOne : kOne}});
  volumes.beginFrame();
  holds = true;
  began = State::Began::Streaming;
  return {};
}

Status Avsm::State::drawParticles(const Light& light, const AvsmParticles& particles) {
  if (Status s = checkStreaming("drawParticles"); !s) return s;
  const gl::StateGuard guard(gl, config.state);
  const avsm::StorageGuard storageGuard(gl, config.state);
  if (Status s = avsm::checkParticles(gl, light, particles, config.layers); !s) return s;
  if (Status s = build(particlesPass()); !s) return s;
  const avsm::ParticlesBlock block = avsm::particlesBlock(light, particles.origin, config.size);
  gl.BindBufferBase(gl::UNIFORM_BUFFER, 0, particlesBlock.name());
  gl.BufferSubData(gl::UNIFORM_BUFFER, 0, sizeof block, block.data());
  gl.BindImageTexture(0, curves.name(), 0, 1, 0, gl::READ_WRITE, gl::RGBA32UI);
  gl.MemoryBarrier(kBarriers);
  insertParticles(particles, static_cast<int>(light.shadow.views.size()));
  return {};
}

// What begin() bound and the guards have left empty.
void Avsm::State::bindListsAgain() {
  if (config.state != StateMode::Leave || began != Began::Capture) return;
  const avsm::BufferGuard guard(gl, config.state);
  lists->bind(firstBinding, false, avsm::kStorageBindings);
}

// Of what was captured: from the first pass since begin() on.
void Avsm::State::record() {
  if (!recording) recorder.beginFrame();
  recording = true;
}

Status Avsm::State::drawVolumes(const Light& light, const std::vector<AvsmVolume>& given) {
  if (began == Began::Nothing)
    return {StatusCode::InvalidFrame, "Avsm::drawVolumes needs a begin() or beginStreaming() before it"};
  gl::StateGuard guard(gl, config.state);
  guard.saveUnits(avsm::kVolumeUnits, {});
  const avsm::StorageGuard storageGuard(gl, config.state);
  const avsm::GridGuard gridGuard(gl, config.state);
  if (Status s = volumes.check(light, given, config.layers); !s) return s;
  for (const Pass& pass : {rangesPass(true), rangesPass(false), volumesPass()})
    if (Status s = build(pass); !s) return s;
  if (Status s = volumes.prepare(light, given, config.size); !s) return s;
  if (began == Began::Capture) record();
  gl.MemoryBarrier(kBarriers);
  volumes.makeRanges([&](int level, const avsm::Groups& groups) {
    run(rangesPass(level == 0), {{"sourceLevel", level - 1}}, groups);
  });
  if (began == Began::Capture) lists->bind(0, false);
  if (began == Began::Streaming) gl.BindImageTexture(0, curves.name(), 0, 1, 0, gl::READ_WRITE, gl::RGBA32UI);
  volumes.draw([&](const avsm::Groups& groups) { run(volumesPass(), {}, groups); });
  return {};
}

Status Avsm::State::bindCurves(int layer) {
  if (Status s = checkStreaming("bindCurves"); !s) return s;
  if (layer < 0 || layer >= config.layers)
    return {StatusCode::InvalidFrame,
            "layer is " + std::to_string(layer) + ": the map has " + std::to_string(config.layers) + " layers"};
  gl::Int bound = 0;
  gl.GetIntegerv(gl::DRAW_FRAMEBUFFER_BINDING, &bound);
  Status status = attachCurves(layer);
  if (!status) gl.BindFramebuffer(gl::DRAW_FRAMEBUFFER, static_cast<gl::Uint>(bound));
  return status;
}

// To a framebuffer that stays bound.
Status Avsm::State::attachCurves(int layer) {
  if (!framebuffer) framebuffer = gl::Framebuffer(gl);
  gl.BindFramebuffer(gl::DRAW_FRAMEBUFFER, framebuffer.name());
  const int count = avsm::curveLayersOf(config) / config.layers;
  std::vector<gl::Enum> buffers;
  for (int i = 0; i < count; ++i) {
    buffers.push_back(gl::COLOR_ATTACHMENT0 + static_cast<gl::Enum>(i));
    gl.FramebufferTextureLayer(gl::DRAW_FRAMEBUFFER, buffers.back(), curves.name(), 0, layer * count + i);
  }
  gl.DrawBuffers(count, buffers.data());
  if (gl.CheckFramebufferStatus(gl::DRAW_FRAMEBUFFER) == gl::FRAMEBUFFER_COMPLETE) return {};
  return {StatusCode::InvalidFrame, "this context cannot draw into curves of " + std::to_string(config.nodes) +
                                        " nodes: " + std::to_string(count) + " layers of RGBA32UI"};
}

Status Avsm::State::makeObjects() {
  const gl::StateGuard guard(gl, StateMode::Restore);
  const avsm::BufferGuard bufferGuard(gl, StateMode::Restore);
  watch.mark();
  return allocate();
}

Status Avsm::State::allocate() {
  gl::OwnErrors errors(gl);
  lists = std::make_unique<avsm::Lists>(gl, config.size, config.layers, config.mostListBytes,
                                        config.reduction == CurveReduction::WholeCurve);
  volumes.makeObjects();
  curves = gl::Texture(gl);
  particlesBlock = gl::Buffer(gl);
  gl.BindBuffer(gl::UNIFORM_BUFFER, particlesBlock.name());
  gl.BufferData(gl::UNIFORM_BUFFER, sizeof(avsm::ParticlesBlock), nullptr, gl::DYNAMIC_DRAW);
  gl.BindTexture(gl::TEXTURE_2D_ARRAY, curves.name());
  gl.TexStorage3D(gl::TEXTURE_2D_ARRAY, 1, gl::RGBA32UI, config.size, config.size, avsm::curveLayersOf(config));
  if (errors.take() != gl::NO_ERROR)
    return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(curveBytes()) + " bytes for curves"};
  for (const gl::Enum filter : {gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER})
    gl.TexParameteri(gl::TEXTURE_2D_ARRAY, filter, gl::NEAREST);
  return {};
}

// Whatever can refuse a pass, before anything is changed.
Status Avsm::State::build(const Pass& pass) {
  if (programs.useCompute(pass.file, pass.definitions)) return {};
  return {StatusCode::ShaderError, "a shader did not build: " + programs.error()};
}

void Avsm::State::run(const Pass& pass, const Uniforms& uniforms, const avsm::Groups& groups) {
  const gl::Uint program = programs.useCompute(pass.file, pass.definitions);
  for (const auto& [uniform, value] : uniforms)
    gl.Uniform1i(gl.GetUniformLocation(program, uniform), value);
  recorder.run(pass.name, [&] {
    gl.DispatchCompute(groups[0], groups[1], groups[2]);
    gl.MemoryBarrier(kBarriers);
    return true;
  });
}

void Avsm::State::runOverMap(const Pass& pass, const Uniforms& uniforms, int layers) {
  const auto groups = static_cast<gl::Uint>(unitsFor(config.size, kGroup));
  run(pass, uniforms, {groups, groups, static_cast<gl::Uint>(layers > 0 ? layers : config.layers)});
}

// Of calls that use programs.
Status Avsm::State::checkContext(const char* function) {
  if (Status s = watch.check(); !s) return s;
  return checkUnderWay(gl, function);
}

Status Avsm::State::checkStreaming(const char* function) const {
  if (began != Began::Streaming)
    return {StatusCode::InvalidFrame, std::string("Avsm::") + function + " needs a beginStreaming() before it"};
  return {};
}

void Avsm::State::insertParticles(const AvsmParticles& particles, int views) {
  gl::Int alignment = 0;
  gl.GetIntegerv(gl::SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
  for (std::uint32_t first = 0; first < particles.count;) {
    const std::uint32_t count = std::min(avsm::kMostParticles, particles.count - first);
    const std::uint64_t at = particles.offset + std::uint64_t{first} * particles.stride;
    const std::uint64_t start = at - at % static_cast<std::uint64_t>(std::max(alignment, 4));
    const std::uint64_t bytes = at - start + std::uint64_t{count - 1} * particles.stride + avsm::kParticleBytes;
    gl.BindBufferRange(gl::SHADER_STORAGE_BUFFER, 0, particles.buffer, static_cast<gl::Intptr>(start),
                       static_cast<gl::Sizeiptr>(bytes));
    const Uniforms uniforms = {{"firstFloat", static_cast<gl::Int>((at - start) / 4)},
                               {"stride", static_cast<gl::Int>(particles.stride / 4)},
                               {"count", static_cast<gl::Int>(count)}};
    runOverMap(particlesPass(), uniforms, views);
    first += count;
  }
}

void Avsm::State::makeCurves() {
  lists->bind(0, true);
  gl.BindImageTexture(0, curves.name(), 0, 1, 0, gl::WRITE_ONLY, gl::RGBA32UI);
  for (const Pass& pass : passesOf(config))
    runOverMap(pass);
}

// ---------------------------------------------------------------------------------------------------------------------

const char* avsmCaptureSource() {
  static const std::string text = shaderSource("public/avsmCapture.glsl");
  return text.c_str();
}

const char* avsmInsertSource() {
  static const std::string text = shaderSource("public/avsmInsert.glsl");
  return text.c_str();
}

const char* avsmLookupSource() {
  static const std::string text = shaderSource("public/avsmLookup.glsl");
  return text.c_str();
}

} // namespace tyndall
