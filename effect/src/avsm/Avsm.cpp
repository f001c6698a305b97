#include "tyndall/avsm.h"

#include "LoadFunctions.h"
#include "PassRecorder.h"
#include "avsm/Lists.h"
#include "avsm/StorageGuard.h"
#include "gl/Program.h"
#include "gl/ShaderSources.h"
#include "gl/StateGuard.h"
#include "optics/Matrices.h"

#include <cmath>
#include <utility>

// A frame's curves (Salvi et al. 2013). Boxes are passes:
//
//   the engine's shaders, avsmCapture.glsl --> lists of segments
//   lists --> [avsmSort] --> lists in the order of entries --> [avsmSort, exits] --> and of exits
//   WholeCurve:       lists in both orders --> [avsmReduce] --> curves
//   Sorted, InOrder:  lists --> [avsmInsert] --> curves
//
namespace tyndall {

namespace {

Status invalid(const std::string& field, const std::string& value, const std::string& rule) {
  return {StatusCode::InvalidConfig, "AvsmConfig::" + field + " is " + value + ": " + rule};
}

Status checkConfig(const AvsmConfig& config) {
  if (!config.loader) return invalid("loader", "null", "must resolve GL functions");
  if (config.timing < PassTiming::Off || config.timing > PassTiming::Finish)
    return invalid("timing", std::to_string(static_cast<int>(config.timing)), "must be one of the enumerators");
  if (config.size < 1 || config.size > 4096) return invalid("size", std::to_string(config.size), "must be 1 to 4096");
  if (config.layers < 1 || config.layers > kMaxShadowViews)
    return invalid("layers", std::to_string(config.layers), "must be 1 to 6");
  if (config.nodes < 4 || config.nodes > 16 || config.nodes % 4 != 0)
    return invalid("nodes", std::to_string(config.nodes), "must be 4, 8, 12 or 16");
  if (config.reduction < CurveReduction::WholeCurve || config.reduction > CurveReduction::InOrder)
    return invalid("reduction", std::to_string(static_cast<int>(config.reduction)), "must be one of the enumerators");
  return {};
}

// What a function of OpenGL 4.3 that is missing is called; empty if none is.
std::string missingFunction(const gl::Functions& gl) {
  const std::pair<const char*, bool> all[] = {
      {"glDispatchCompute", gl.DispatchCompute},   {"glMemoryBarrier", gl.MemoryBarrier},
      {"glBindImageTexture", gl.BindImageTexture}, {"glTexStorage3D", gl.TexStorage3D},
      {"glBufferSubData", gl.BufferSubData},       {"glClearBufferSubData", gl.ClearBufferSubData}};
  for (const auto& [name, known] : all)
    if (!known) return name;
  return {};
}

constexpr int kGroup = 8; // texels across and up a work group (lib/avsm.glsl)

} // namespace

struct Avsm::State {
  explicit State(const AvsmConfig& c) : config(c), programs(gl), recorder(gl, c.timing) {}

  AvsmConfig config;
  gl::Functions gl;
  gl::ProgramCache programs;
  PassRecorder recorder;
  std::unique_ptr<avsm::Lists> lists;
  gl::Texture curves;
  std::uint64_t version = 0;
  bool began = false;
  bool holds = false; // anything may be captured

  Status makeCurves();
  Status makeObjects();
  Status run(const std::string& name, const std::string& file, const gl::Definitions& definitions);
  Status makeOrder();
  Status dispatchAll();
  int curveLayers() const { return config.layers * config.nodes / (config.packed ? 4 : 2); }
  std::uint64_t curveBytes() const {
    return std::uint64_t{16} * static_cast<std::uint64_t>(config.size) * static_cast<std::uint64_t>(config.size) *
           static_cast<std::uint64_t>(curveLayers());
  }
  gl::Enum format() const { return config.packed ? gl::RGBA32UI : gl::RGBA32F; }
  gl::Definitions curveDefinitions() const { return {{"NODES", config.nodes}, {"PACKED", config.packed ? 1 : 0}}; }
};

Avsm::Avsm(std::unique_ptr<State> state) : state_(std::move(state)) {}
Avsm::~Avsm() = default;

AvsmResult Avsm::create(const AvsmConfig& config) {
  if (Status s = checkConfig(config); !s) return {nullptr, s};
  auto state = std::make_unique<State>(config);
  const gl::Functions& gl = state->gl;
  if (Status s = loadFunctions(state->gl, config.loader, 43, " for an adaptive volumetric shadow map"); !s)
    return {nullptr, s};
  if (const std::string function = missingFunction(gl); !function.empty())
    return {nullptr, {StatusCode::ContextTooOld, "the loader knows no " + function}};
  if (Status s = state->makeObjects(); !s) return {nullptr, s};
  return {std::unique_ptr<Avsm>(new Avsm(std::move(state))), {}};
}

Status Avsm::begin(std::uint32_t firstBinding) {
  State& state = *state_;
  if (!state.gl.GetString(gl::VERSION)) return {StatusCode::NoContext, "no GL context is current on this thread"};
  gl::Int bindings = 0;
  state.gl.GetIntegerv(gl::MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
  if (bindings < 2 || firstBinding > static_cast<std::uint32_t>(bindings) - 2)
    return {StatusCode::InvalidConfig, "firstBinding is " + std::to_string(firstBinding) +
                                           ": this and the next must be below this context's " +
                                           std::to_string(bindings) + " storage buffer bindings"};
  const avsm::BufferGuard guard(state.gl);
  state.began = false;
  if (Status s = state.lists->empty(); !s) return s;
  state.lists->bind(firstBinding, false);
  state.began = true;
  return {};
}

Status Avsm::resolve() {
  State& state = *state_;
  if (!state.gl.GetString(gl::VERSION)) return {StatusCode::NoContext, "no GL context is current on this thread"};
  if (!state.began) return {StatusCode::InvalidFrame, "Avsm::resolve needs a begin() before it"};
  state.began = false;
  const gl::StateGuard guard(state.gl);
  const avsm::StorageGuard storageGuard(state.gl);
  state.recorder.beginFrame();
  state.gl.MemoryBarrier(gl::SHADER_STORAGE_BARRIER_BIT | gl::BUFFER_UPDATE_BARRIER_BIT);
  ++state.version;
  // Scenes without smoke pay a wait instead of passes; the others do not wait.
  if (!state.holds) state.holds = state.lists->header().firsts > 0;
  if (!state.holds) {
    state.recorder.skip("curves", "no segment was captured");
    return {};
  }
  return state.makeCurves();
}

AvsmCurves Avsm::curves() const {
  const State& state = *state_;
  return {state.holds ? state.curves.name() : 0, state.config.nodes, state.config.packed, state.version};
}

AvsmStatistics Avsm::statistics() {
  State& state = *state_;
  const avsm::BufferGuard guard(state.gl);
  const avsm::ListsHeader header = state.version > 0 ? state.lists->header() : avsm::ListsHeader{};
  return {state.recorder.collect(), header.captured(), header.lost, state.lists->bytes(), state.curveBytes()};
}

// ---------------------------------------------------------------------------------------------------------------------

Status Avsm::State::makeObjects() {
  const gl::StateGuard guard(gl);
  lists = std::make_unique<avsm::Lists>(gl, config.size, config.layers, config.mostListBytes);
  curves = gl::Texture(gl);
  gl.ActiveTexture(gl::TEXTURE0);
  gl.BindTexture(gl::TEXTURE_2D_ARRAY, curves.name());
  while (gl.GetError() != gl::NO_ERROR) {
  }
  gl.TexStorage3D(gl::TEXTURE_2D_ARRAY, 1, format(), config.size, config.size, curveLayers());
  if (gl.GetError() != gl::NO_ERROR)
    return {StatusCode::OutOfMemory, "GL could not allocate " + std::to_string(curveBytes()) + " bytes for curves"};
  for (const gl::Enum filter : {gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER})
    gl.TexParameteri(gl::TEXTURE_2D_ARRAY, filter, gl::NEAREST);
  return {};
}

Status Avsm::State::run(const std::string& name, const std::string& file, const gl::Definitions& definitions) {
  const gl::Uint program = programs.useCompute(file, definitions);
  if (!program) return {StatusCode::ShaderError, "a shader did not build: " + programs.error()};
  recorder.run(name, [&] {
    const auto groups = static_cast<gl::Uint>((config.size + kGroup - 1) / kGroup);
    gl.DispatchCompute(groups, groups, static_cast<gl::Uint>(config.layers));
    gl.MemoryBarrier(gl::SHADER_STORAGE_BARRIER_BIT | gl::TEXTURE_FETCH_BARRIER_BIT);
    return true;
  });
  return {};
}

// The lists in the order of entries; to reduce whole curves, of exits as well.
Status Avsm::State::makeOrder() {
  const bool withExits = config.reduction == CurveReduction::WholeCurve;
  for (int exits = 0; exits < (withExits ? 2 : 1); ++exits) {
    const std::string name = exits == 1 ? "sort exits" : "sort entries";
    if (Status s = run(name, "passes/avsmSort.comp", {{"EXITS", exits}}); !s) return s;
  }
  return {};
}

Status Avsm::State::makeCurves() {
  lists->bind(0, true);
  gl.BindImageTexture(0, curves.name(), 0, 1, 0, gl::WRITE_ONLY, format());
  if (config.reduction != CurveReduction::InOrder)
    if (Status s = makeOrder(); !s) return s;
  const bool whole = config.reduction == CurveReduction::WholeCurve;
  return run(whole ? "reduce" : "insert", whole ? "passes/avsmReduce.comp" : "passes/avsmInsert.comp",
             curveDefinitions());
}

// ---------------------------------------------------------------------------------------------------------------------

Status avsmDepth(const Light& light, int view, std::array<double, 4>& depth) {
  const auto refuse = [&](const std::string& rule) {
    return Status{StatusCode::InvalidFrame, "view is " + std::to_string(view) + ": " + rule};
  };
  if (view < 0 || view >= static_cast<int>(light.shadow.views.size()))
    return refuse("the light has " + std::to_string(light.shadow.views.size()) + " shadow views");
  const glm::dmat4 matrix = optics::toGlm(light.shadow.views[static_cast<std::size_t>(view)].clipFromWorld);
  if (!optics::isInvertible(matrix)) return refuse("its matrix must be invertible");
  const optics::DepthPlane plane = optics::linearDepth(light, view);
  if (!plane.exists) return refuse("its far plane must not be at infinity");
  depth = {plane.coefficients.x, plane.coefficients.y, plane.coefficients.z, plane.coefficients.w};
  return {};
}

const char* avsmCaptureSource() { return shaderSource("public/avsmCapture.glsl"); }
const char* avsmLookupSource() { return shaderSource("public/avsmLookup.glsl"); }

} // namespace tyndall
