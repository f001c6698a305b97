// The public functions of an effect, and what it makes once.
#include "EffectState.h"
#include "LoadFunctions.h"
#include "gl/OwnErrors.h"
#include "gl/StateGuard.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tyndall {

namespace {

std::string rendererOf(const gl::Functions& gl) {
  const auto* name = gl.GetString(gl::RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "";
}

// 0 too from a driver that does not know the question.
int dualSourceBuffersOf(const gl::Functions& gl) {
  if (!gl.dualSource) return 0;
  gl::OwnErrors errors(gl);
  gl::Int count = 0;
  gl.GetIntegerv(gl::MAX_DUAL_SOURCE_DRAW_BUFFERS, &count);
  return errors.take() == gl::NO_ERROR ? count : 0;
}

} // namespace

Effect::Effect(std::unique_ptr<State> state) : state_(std::move(state)) {}
Effect::~Effect() = default;

CreateResult Effect::create(const Config& config) {
  const auto invalid = [](const std::string& message) { return Status{StatusCode::InvalidConfig, message}; };
  const auto outside = [&](const char* field, int value) {
    return invalid(std::string("Config::") + field + " is " + std::to_string(value) +
                   ": must be one of the enumerators");
  };
  if (!config.loader) return {nullptr, invalid("Config::loader is null: a function that resolves GL names is needed")};
  if (config.timing < PassTiming::Off || config.timing > PassTiming::Finish)
    return {nullptr, outside("timing", static_cast<int>(config.timing))};
  if (config.state < StateMode::Restore || config.state > StateMode::Leave)
    return {nullptr, outside("state", static_cast<int>(config.state))};
  if (Status s = checkTuning(config.tuning); !s) return {nullptr, s};
  auto state = std::make_unique<State>(config);
  if (Status s = loadFunctions(state->gl, config.loader, 33, {}); !s) return {nullptr, s};
  if (config.timing == PassTiming::TimerQuery && !state->gl.timerQueries)
    return {nullptr, invalid("Config::timing is TimerQuery: this context has no GL_EXT_disjoint_timer_query")};
  if (Status s = checkLists(state->gl, "Effect::create"); !s) return {nullptr, s};
  state->createObjects();
  if (Status s = state->watch.finish({}); !s) return {nullptr, s};
  return {std::unique_ptr<Effect>(new Effect(std::move(state))), {}};
}

Status Effect::render(const Frame& frame) {
  State& state = *state_;
  if (Status s = state.check("Effect::render"); !s) return s;
  return state.watch.finish(state.render(frame));
}

PrepareStatus Effect::prepare(const Frame& frame) {
  State& state = *state_;
  if (Status s = state.check("Effect::prepare"); !s) return {s};
  PrepareStatus status = state.prepare(frame);
  status.status = state.watch.finish(status.status);
  return status;
}

Status Effect::compileAll() {
  State& state = *state_;
  if (Status s = state.check("Effect::compileAll"); !s) return s;
  return state.watch.finish(state.compileAll());
}

Statistics Effect::statistics() {
  State& state = *state_;
  KeptEye* const eye = state.lastEye ? state.eyes.find(*state.lastEye) : nullptr;
  const PassRecorder::Counts& counts = state.recorder.counts();
  return {state.recorder.collect(),
          state.targets.bytes() + state.eyes.bytes() + state.objectBoxes.bytes() + state.inputChecks.bytes() +
              state.blocks.bytes(),
          state.programs.size(),
          counts.fixupPixels,
          counts.marched,
          counts.slices,
          counts.errorEstimate,
          counts.shareOverTarget,
          eye ? eye->counts.lastShare() : 1,
          state.visitsPerRay(),
          state.tuning,
          state.warnings};
}

// ---------------------------------------------------------------------------------------------------------------------

void Effect::State::createObjects() {
  const gl::StateGuard guard(gl, StateMode::Restore);
  watch.mark();
  gl.GetIntegerv(gl::MAX_TEXTURE_SIZE, &limits.textureSize);
  gl.GetIntegerv(gl::UNIFORM_BUFFER_OFFSET_ALIGNMENT, &limits.blockAlignment);
  limits.blockAlignment = std::max(limits.blockAlignment, 16);
  tuning = tuningFor(tuning, rendererOf(gl), dualSourceBuffersOf(gl));
  vertexArray = gl::VertexArray(gl);
  gl.BindVertexArray(vertexArray.name()); // a name becomes an object when it is first bound
  nearestSampler = gl::Sampler(gl);
  for (const gl::Enum filter : {gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER})
    gl.SamplerParameteri(nearestSampler.name(), filter, gl::NEAREST);
  for (const gl::Enum wrap : {gl::TEXTURE_WRAP_S, gl::TEXTURE_WRAP_T})
    gl.SamplerParameteri(nearestSampler.name(), wrap, gl::CLAMP_TO_EDGE);
  gl.SamplerParameteri(nearestSampler.name(), gl::TEXTURE_COMPARE_MODE, gl::NONE);
}

Status Effect::State::check(const char* function) {
  if (Status s = watch.check(); !s) return s;
  return checkUnderWay(gl, function);
}

// Waits for the GPU, which who asks for statistics may.
double Effect::State::visitsPerRay() const {
  if (visits == 0) return 0;
  gl::StateGuard guard(gl, StateMode::Restore);
  guard.saveReadFramebuffer();
  const gl::PackGuard packing(gl, StateMode::Restore);
  const gl::Framebuffer framebuffer(gl);
  gl.BindFramebuffer(gl::READ_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferTexture2D(gl::READ_FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, visits, 0);
  std::array<gl::Float, 4> mean = {};
  gl.ReadPixels(0, 0, 1, 1, gl::RGBA, gl::FLOAT, mean.data());
  return mean[0];
}

// ---------------------------------------------------------------------------------------------------------------------

namespace {

template <typename Number>
Mat4 copyOf(const Number* elements, std::size_t row, std::size_t column) {
  Mat4 m{};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r)
      m[4 * c + r] = static_cast<double>(elements[column * c + row * r]);
  return m;
}

} // namespace

Mat4 mat4(const float* columnMajor) { return copyOf(columnMajor, 1, 4); }

Mat4 mat4(const double* columnMajor) { return copyOf(columnMajor, 1, 4); }

Mat4 mat4RowMajor(const float* rowMajor) { return copyOf(rowMajor, 4, 1); }

Mat4 mat4RowMajor(const double* rowMajor) { return copyOf(rowMajor, 4, 1); }

} // namespace tyndall
