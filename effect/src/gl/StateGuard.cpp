#include "gl/StateGuard.h"

#include <algorithm>
#include <utility>

namespace tyndall::gl {

namespace {

constexpr std::array<Enum, 6> kTargets = {
    TEXTURE_2D,       TEXTURE_2D_ARRAY,      TEXTURE_2D_MULTISAMPLE, TEXTURE_2D_MULTISAMPLE_ARRAY,
    TEXTURE_CUBE_MAP, TEXTURE_CUBE_MAP_ARRAY}; // which not all contexts have
constexpr std::array<Enum, 6> kTargetBindings = {TEXTURE_BINDING_2D,
                                                 TEXTURE_BINDING_2D_ARRAY,
                                                 TEXTURE_BINDING_2D_MULTISAMPLE,
                                                 TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
                                                 TEXTURE_BINDING_CUBE_MAP,
                                                 TEXTURE_BINDING_CUBE_MAP_ARRAY};

// Whatever would keep a full-screen triangle from writing exactly its colours. Clip distances are added per context.
constexpr std::array<Enum, 8> kCapabilities = {
    CULL_FACE, DEPTH_TEST, STENCIL_TEST, RASTERIZER_DISCARD, SAMPLE_MASK, SAMPLE_COVERAGE, SAMPLE_ALPHA_TO_COVERAGE,
    DITHER};
constexpr std::array<Enum, 4> kDesktopCapabilities = {COLOR_LOGIC_OP, FRAMEBUFFER_SRGB, SAMPLE_ALPHA_TO_ONE,
                                                      POLYGON_SMOOTH};

// What transfers of two-dimensional textures look at.
using PixelStorage = std::array<Enum, 5>;
constexpr PixelStorage kUnpacking = {UNPACK_SWAP_BYTES, UNPACK_ROW_LENGTH, UNPACK_SKIP_ROWS, UNPACK_SKIP_PIXELS,
                                     UNPACK_ALIGNMENT};
constexpr PixelStorage kPacking = {PACK_SWAP_BYTES, PACK_ROW_LENGTH, PACK_SKIP_ROWS, PACK_SKIP_PIXELS, PACK_ALIGNMENT};
constexpr std::array<Int, 5> kStorageDefaults = {0, 0, 0, 0, 4};

constexpr std::array<Enum, 4> kFactors = {BLEND_SRC_RGB, BLEND_DST_RGB, BLEND_SRC_ALPHA, BLEND_DST_ALPHA};
constexpr std::array<Enum, 2> kEquations = {BLEND_EQUATION_RGB, BLEND_EQUATION_ALPHA};
constexpr std::array<Int, 4> kReplacing = {ONE, ZERO, ONE, ZERO};
constexpr std::array<Int, 2> kAdding = {FUNC_ADD, FUNC_ADD};
constexpr std::array<Boolean, 4> kAllChannels = {1, 1, 1, 1};
constexpr std::array<Int, 2> kClipDefaults = {LOWER_LEFT,
                                              NEGATIVE_ONE_TO_ONE}; // strips and tiles stand by clip-space y

Int integer(const Functions& gl, Enum name) {
  Int value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

// None for one that the engine has deleted: it goes with the first of ours that becomes current, and no call gives it
// back.
Int currentProgram(const Functions& gl) {
  const Int program = integer(gl, CURRENT_PROGRAM);
  Int deleted = 0;
  if (program != 0) gl.GetProgramiv(static_cast<Uint>(program), DELETE_STATUS, &deleted);
  return deleted != 0 ? 0 : program;
}

template <typename Action>
void forEachCapability(const Functions& gl, Action&& action) {
  for (const Enum capability : kCapabilities)
    action(capability);
  if (gl.language == Language::Glsl)
    for (const Enum capability : kDesktopCapabilities)
      action(capability);
  for (int i = 0; i < gl.clipDistances; ++i)
    action(CLIP_DISTANCE0 + static_cast<Enum>(i));
}

void setClipControl(const Functions& gl, const std::array<Int, 2>& control) {
  if (gl.ClipControl) gl.ClipControl(static_cast<Enum>(control[0]), static_cast<Enum>(control[1]));
}

void setFactors(const Functions& gl, Uint buffer, const std::array<Int, 4>& factors) {
  const auto factor = [&](std::size_t k) { return static_cast<Enum>(factors[k]); };
  if (gl.indexedBlending)
    gl.BlendFuncSeparatei(buffer, factor(0), factor(1), factor(2), factor(3));
  else if (buffer == 0)
    gl.BlendFuncSeparate(factor(0), factor(1), factor(2), factor(3));
}

void setEquations(const Functions& gl, Uint buffer, const std::array<Int, 2>& equations) {
  const auto equation = [&](std::size_t k) { return static_cast<Enum>(equations[k]); };
  if (gl.indexedBlending)
    gl.BlendEquationSeparatei(buffer, equation(0), equation(1));
  else if (buffer == 0)
    gl.BlendEquationSeparate(equation(0), equation(1));
}

bool hasStorage(const Functions& gl, Enum name) {
  return gl.language == Language::Glsl || (name != UNPACK_SWAP_BYTES && name != PACK_SWAP_BYTES);
}

std::array<Int, 5> pixelStorage(const Functions& gl, const PixelStorage& names) {
  std::array<Int, 5> values{};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (hasStorage(gl, names[i])) values[i] = integer(gl, names[i]);
  return values;
}

// Sets those that are not what they were.
void setPixelStorage(const Functions& gl, const PixelStorage& names, const std::array<Int, 5>& values,
                     const std::array<Int, 5>& before) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (values[i] != before[i] && hasStorage(gl, names[i])) gl.PixelStorei(names[i], values[i]);
}

constexpr std::array<Int, 5> kUnknown = {-1, -1, -1, -1, -1};

} // namespace

StateGuard::StateGuard(const Functions& gl, StateMode mode) : gl_(gl), mode_(mode), legacy_(gl) {
  if (restores()) {
    legacy_.save();
    save();
    clearSaved();
  } else {
    setDefaults();
  }
}

StateGuard::~StateGuard() { restores() ? restore() : leave(); }

void StateGuard::save() {
  program_ = currentProgram(gl_);
  vertexArray_ = integer(gl_, VERTEX_ARRAY_BINDING);
  framebuffer_ = integer(gl_, DRAW_FRAMEBUFFER_BINDING);
  renderbuffer_ = integer(gl_, RENDERBUFFER_BINDING);
  unpackBuffer_ = integer(gl_, PIXEL_UNPACK_BUFFER_BINDING);
  unpacking_ = pixelStorage(gl_, kUnpacking);
  if (gl_.PolygonMode) gl_.GetIntegerv(POLYGON_MODE, polygonMode_.data());
  if (gl_.ClipControl) clipControl_ = {integer(gl_, CLIP_ORIGIN), integer(gl_, CLIP_DEPTH_MODE)};
  forEachCapability(gl_, [&](Enum capability) {
    if (gl_.IsEnabled(capability)) capabilities_.push_back(capability);
  });
  saveUniformBindings();
  saveDrawBuffers();
  saveViewport();
  activeUnit_ = integer(gl_, ACTIVE_TEXTURE);
  gl_.ActiveTexture(TEXTURE0);
  saveUnit(0, {true, true, true, true, true, gl_.cubeArrays});
}

// What a pass expects, of what is not so.
void StateGuard::clearSaved() const {
  for (const Enum capability : capabilities_)
    gl_.Disable(capability);
  if (scissor_) setScissorTest(gl_, false);
  if (polygonMode_[0] != FILL) gl_.PolygonMode(FRONT_AND_BACK, FILL);
  if (gl_.ClipControl && clipControl_ != kClipDefaults) setClipControl(gl_, kClipDefaults);
  if (unpackBuffer_ != 0) gl_.BindBuffer(PIXEL_UNPACK_BUFFER, 0);
  setPixelStorage(gl_, kUnpacking, kStorageDefaults, unpacking_);
  for (Uint i = 0; i < kDrawBuffers; ++i) {
    const DrawBuffer& buffer = drawBuffers_[i];
    if (buffer.blend) gl_.Disablei(BLEND, i);
    if (buffer.mask != kAllChannels) gl_.ColorMaski(i, 1, 1, 1, 1);
    if (buffer.factors != kReplacing) setFactors(gl_, i, kReplacing);
    if (buffer.equations != kAdding) setEquations(gl_, i, kAdding);
  }
}

void StateGuard::restore() const {
  // Under active transform feedback GL refuses even the same.
  if (integer(gl_, CURRENT_PROGRAM) != program_) gl_.UseProgram(static_cast<Uint>(program_));
  gl_.BindVertexArray(static_cast<Uint>(vertexArray_));
  gl_.BindFramebuffer(DRAW_FRAMEBUFFER, static_cast<Uint>(framebuffer_));
  gl_.BindRenderbuffer(RENDERBUFFER, static_cast<Uint>(renderbuffer_));
  if (unpackBuffer_ != 0) gl_.BindBuffer(PIXEL_UNPACK_BUFFER, static_cast<Uint>(unpackBuffer_));
  setPixelStorage(gl_, kUnpacking, unpacking_, kStorageDefaults);
  if (polygonMode_[0] != FILL) gl_.PolygonMode(FRONT_AND_BACK, static_cast<Enum>(polygonMode_[0]));
  if (gl_.ClipControl && clipControl_ != kClipDefaults) setClipControl(gl_, clipControl_);
  for (const Enum capability : capabilities_)
    gl_.Enable(capability);
  restoreUniformBindings();
  restoreUnits();
  restoreDrawBuffers();
  if (gl_.viewportArrays)
    gl_.ViewportIndexedf(0, viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  else
    gl_.Viewport(static_cast<Int>(viewport_[0]), static_cast<Int>(viewport_[1]), static_cast<Sizei>(viewport_[2]),
                 static_cast<Sizei>(viewport_[3]));
  if (scissorBox_) setScissor(gl_, *scissorBox_);
  if (scissor_) setScissorTest(gl_, true);
  if (savesStencil_) restoreStencil();
  if (savesReadFramebuffer_) gl_.BindFramebuffer(READ_FRAMEBUFFER, static_cast<Uint>(readFramebuffer_));
  legacy_.restore();
}

// ---------------------------------------------------------------------------------------------------------------------

void StateGuard::saveUniformBindings() {
  uniformBuffer_ = integer(gl_, UNIFORM_BUFFER_BINDING);
  for (std::size_t i = 0; i < uniformBindings_.size(); ++i) {
    const auto index = static_cast<Uint>(i);
    gl_.GetIntegeri_v(UNIFORM_BUFFER_BINDING, index, &uniformBindings_[i].buffer);
    gl_.GetInteger64i_v(UNIFORM_BUFFER_START, index, &uniformBindings_[i].start);
    gl_.GetInteger64i_v(UNIFORM_BUFFER_SIZE, index, &uniformBindings_[i].size);
  }
}

void StateGuard::restoreUniformBindings() const {
  for (std::size_t i = 0; i < uniformBindings_.size(); ++i) {
    const UniformBinding& binding = uniformBindings_[i];
    const auto index = static_cast<Uint>(i);
    const auto buffer = static_cast<Uint>(binding.buffer);
    if (binding.size > 0)
      gl_.BindBufferRange(UNIFORM_BUFFER, index, buffer, static_cast<Intptr>(binding.start),
                          static_cast<Sizeiptr>(binding.size));
    else
      gl_.BindBufferBase(UNIFORM_BUFFER, index, buffer);
  }
  gl_.BindBuffer(UNIFORM_BUFFER, static_cast<Uint>(uniformBuffer_)); // after the indexed ones: they bind it too
}

void StateGuard::saveUnits(int count, const TextureKinds& kinds) {
  const int first = unitCount_;
  unitCount_ = std::max(count, first);
  unitTargets_ = {true,
                  unitTargets_[1] || kinds.arrays,
                  unitTargets_[2] || kinds.multisampled,
                  unitTargets_[3] || kinds.multisampled,
                  unitTargets_[4] || kinds.cubes,
                  unitTargets_[5] || kinds.cubeArrays};
  if (!restores()) return;
  for (int i = first; i < unitCount_; ++i) {
    gl_.ActiveTexture(TEXTURE0 + static_cast<Enum>(i));
    saveUnit(i, unitTargets_);
  }
  if (unitCount_ > first) gl_.ActiveTexture(TEXTURE0);
}

// The unit is active.
void StateGuard::saveUnit(int index, const std::array<bool, kTargetCount>& targets) {
  units_.resize(static_cast<std::size_t>(index) + 1);
  Unit& unit = units_.back();
  for (std::size_t t = 0; t < kTargets.size(); ++t)
    if (targets[t]) unit.textures[t] = integer(gl_, kTargetBindings[t]);
  unit.sampler = integer(gl_, SAMPLER_BINDING);
}

// In the first unit textures of all kinds are looked at.
bool StateGuard::isBoundIn(int unit, std::size_t target) const {
  return unit > 0 ? unitTargets_[target] : kTargets[target] != TEXTURE_CUBE_MAP_ARRAY || gl_.cubeArrays;
}

void StateGuard::restoreUnits() const {
  std::vector<Uint> samplers;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    gl_.ActiveTexture(TEXTURE0 + static_cast<Enum>(i));
    for (std::size_t t = 0; t < kTargets.size(); ++t)
      if (isBoundIn(static_cast<int>(i), t)) gl_.BindTexture(kTargets[t], static_cast<Uint>(units_[i].textures[t]));
    samplers.push_back(static_cast<Uint>(units_[i].sampler));
    if (!gl_.BindSamplers) gl_.BindSampler(static_cast<Uint>(i), samplers.back());
  }
  if (gl_.BindSamplers) gl_.BindSamplers(0, static_cast<Sizei>(samplers.size()), samplers.data());
  gl_.ActiveTexture(static_cast<Enum>(activeUnit_));
}

void StateGuard::saveDrawBuffers() {
  const bool indexed = gl_.indexedBlending;
  for (Uint i = 0; i < kDrawBuffers; ++i) {
    DrawBuffer& buffer = drawBuffers_[i];
    buffer.blend = gl_.IsEnabledi(BLEND, i);
    gl_.GetBooleani_v(COLOR_WRITEMASK, i, buffer.mask.data());
    if (!indexed && i > 0) { // one function for all
      buffer.factors = drawBuffers_[0].factors;
      buffer.equations = drawBuffers_[0].equations;
      continue;
    }
    const auto save = [&](Enum name, Int& value) {
      indexed ? gl_.GetIntegeri_v(name, i, &value) : gl_.GetIntegerv(name, &value);
    };
    for (std::size_t k = 0; k < kFactors.size(); ++k)
      save(kFactors[k], buffer.factors[k]);
    for (std::size_t k = 0; k < kEquations.size(); ++k)
      save(kEquations[k], buffer.equations[k]);
  }
}

void StateGuard::restoreDrawBuffers() const {
  for (Uint i = 0; i < kDrawBuffers; ++i) {
    const DrawBuffer& buffer = drawBuffers_[i];
    (buffer.blend ? gl_.Enablei : gl_.Disablei)(BLEND, i);
    if (buffer.mask != kAllChannels) gl_.ColorMaski(i, buffer.mask[0], buffer.mask[1], buffer.mask[2], buffer.mask[3]);
    setFactors(gl_, i, buffer.factors);
    if (buffer.equations != kAdding) setEquations(gl_, i, buffer.equations);
  }
}

void StateGuard::saveViewport() {
  if (gl_.viewportArrays) {
    gl_.GetFloati_v(VIEWPORT, 0, viewport_.data());
    scissor_ = gl_.IsEnabledi(SCISSOR_TEST, 0);
    return;
  }
  std::array<Int, 4> rectangle{};
  gl_.GetIntegerv(VIEWPORT, rectangle.data());
  std::transform(rectangle.begin(), rectangle.end(), viewport_.begin(), [](Int v) { return static_cast<Float>(v); });
  scissor_ = gl_.IsEnabled(SCISSOR_TEST);
}

void StateGuard::saveStencil() {
  if (std::exchange(savesStencil_, true) || !restores()) return;
  stencil_[0] = {integer(gl_, STENCIL_FUNC),           integer(gl_, STENCIL_REF),
                 integer(gl_, STENCIL_VALUE_MASK),     integer(gl_, STENCIL_WRITEMASK),
                 integer(gl_, STENCIL_FAIL),           integer(gl_, STENCIL_PASS_DEPTH_FAIL),
                 integer(gl_, STENCIL_PASS_DEPTH_PASS)};
  stencil_[1] = {integer(gl_, STENCIL_BACK_FUNC),           integer(gl_, STENCIL_BACK_REF),
                 integer(gl_, STENCIL_BACK_VALUE_MASK),     integer(gl_, STENCIL_BACK_WRITEMASK),
                 integer(gl_, STENCIL_BACK_FAIL),           integer(gl_, STENCIL_BACK_PASS_DEPTH_FAIL),
                 integer(gl_, STENCIL_BACK_PASS_DEPTH_PASS)};
}

void StateGuard::saveReadFramebuffer() {
  if (std::exchange(savesReadFramebuffer_, true) || !restores()) return;
  readFramebuffer_ = integer(gl_, READ_FRAMEBUFFER_BINDING);
}

void StateGuard::saveScissorBox() {
  if (scissorBox_ || !restores()) return;
  scissorBox_.emplace();
  if (gl_.viewportArrays)
    gl_.GetIntegeri_v(SCISSOR_BOX, 0, scissorBox_->data());
  else
    gl_.GetIntegerv(SCISSOR_BOX, scissorBox_->data());
}

void StateGuard::restoreStencil() const {
  for (std::size_t i = 0; i < 2; ++i) {
    const StencilFace& f = stencil_[i];
    const Enum face = i == 0 ? FRONT : BACK;
    gl_.StencilFuncSeparate(face, static_cast<Enum>(f.function), f.reference, static_cast<Uint>(f.valueMask));
    gl_.StencilOpSeparate(face, static_cast<Enum>(f.fail), static_cast<Enum>(f.depthFail), static_cast<Enum>(f.pass));
    gl_.StencilMaskSeparate(face, static_cast<Uint>(f.writeMask));
  }
}

// ---------------------------------------------------------------------------------------------------------------------

// What a pass expects, whatever there was.
void StateGuard::setDefaults() const {
  forEachCapability(gl_, [&](Enum capability) { gl_.Disable(capability); });
  legacy_.setDefaults();
  gl_.Disable(SCISSOR_TEST);
  gl_.Disable(BLEND);
  gl_.BlendFuncSeparate(ONE, ZERO, ONE, ZERO);
  gl_.BlendEquationSeparate(FUNC_ADD, FUNC_ADD);
  gl_.ColorMask(1, 1, 1, 1);
  if (gl_.PolygonMode) gl_.PolygonMode(FRONT_AND_BACK, FILL);
  setClipControl(gl_, kClipDefaults);
  gl_.BindBuffer(PIXEL_UNPACK_BUFFER, 0);
  setPixelStorage(gl_, kUnpacking, kStorageDefaults, kUnknown);
  gl_.ActiveTexture(TEXTURE0);
}

// What passes may have changed.
void StateGuard::leave() const {
  gl_.UseProgram(0);
  gl_.BindVertexArray(0);
  gl_.BindFramebuffer(DRAW_FRAMEBUFFER, 0);
  if (savesReadFramebuffer_) gl_.BindFramebuffer(READ_FRAMEBUFFER, 0);
  gl_.BindRenderbuffer(RENDERBUFFER, 0);
  for (Uint i = 0; i < kUniformBindings; ++i)
    gl_.BindBufferBase(UNIFORM_BUFFER, i, 0);
  emptyUnits();
  gl_.Disable(BLEND);
  gl_.BlendFuncSeparate(ONE, ZERO, ONE, ZERO);
  gl_.StencilFunc(ALWAYS, 0, ~0U);
  gl_.StencilOp(KEEP, KEEP, KEEP);
  gl_.StencilMask(~0U);
}

void StateGuard::emptyUnits() const {
  if (gl_.BindTextures) {
    gl_.BindTextures(0, unitCount_, nullptr);
    gl_.BindSamplers(0, unitCount_, nullptr);
  }
  for (int i = unitCount_ - 1; i >= 0 && !gl_.BindTextures; --i) {
    gl_.ActiveTexture(TEXTURE0 + static_cast<Enum>(i));
    for (std::size_t t = 0; t < kTargets.size(); ++t)
      if (isBoundIn(i, t)) gl_.BindTexture(kTargets[t], 0);
    gl_.BindSampler(static_cast<Uint>(i), 0);
  }
  gl_.ActiveTexture(TEXTURE0);
}

// ---------------------------------------------------------------------------------------------------------------------

PackGuard::PackGuard(const Functions& gl, StateMode mode) : gl_(gl), mode_(mode) {
  const bool restores = mode == StateMode::Restore;
  if (restores) buffer_ = integer(gl, PIXEL_PACK_BUFFER_BINDING);
  packing_ = restores ? pixelStorage(gl, kPacking) : kUnknown;
  if (buffer_ != 0 || !restores) gl.BindBuffer(PIXEL_PACK_BUFFER, 0);
  setPixelStorage(gl, kPacking, kStorageDefaults, packing_);
}

PackGuard::~PackGuard() {
  if (mode_ != StateMode::Restore) return;
  if (buffer_ != 0) gl_.BindBuffer(PIXEL_PACK_BUFFER, static_cast<Uint>(buffer_));
  setPixelStorage(gl_, kPacking, packing_, kStorageDefaults);
}

void setViewport(const Functions& gl, Int x, Int y, Sizei width, Sizei height) {
  if (gl.viewportArrays)
    gl.ViewportIndexedf(0, static_cast<Float>(x), static_cast<Float>(y), static_cast<Float>(width),
                        static_cast<Float>(height));
  else
    gl.Viewport(x, y, width, height);
}

void setScissor(const Functions& gl, const std::array<Int, 4>& box) {
  if (gl.viewportArrays)
    gl.ScissorIndexed(0, box[0], box[1], box[2], box[3]);
  else
    gl.Scissor(box[0], box[1], box[2], box[3]);
}

void setScissorTest(const Functions& gl, bool on) {
  if (gl.viewportArrays)
    (on ? gl.Enablei : gl.Disablei)(SCISSOR_TEST, 0);
  else
    (on ? gl.Enable : gl.Disable)(SCISSOR_TEST);
}

void setBlending(const Functions& gl, Uint count, bool on, const BlendFactors& factors) {
  for (Uint i = 0; i < count; ++i) {
    (on ? gl.Enablei : gl.Disablei)(BLEND, i);
    setFactors(gl, i,
               {static_cast<Int>(factors.source), static_cast<Int>(factors.destination),
                static_cast<Int>(factors.sourceAlpha), static_cast<Int>(factors.destinationAlpha)});
  }
}

} // namespace tyndall::gl
