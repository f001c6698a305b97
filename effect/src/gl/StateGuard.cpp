#include "gl/StateGuard.h"

namespace tyndall::gl {

namespace {

constexpr std::array<Enum, 3> kTargets = {TEXTURE_2D, TEXTURE_2D_ARRAY, TEXTURE_2D_MULTISAMPLE};
constexpr std::array<Enum, 3> kTargetBindings = {TEXTURE_BINDING_2D, TEXTURE_BINDING_2D_ARRAY,
                                                 TEXTURE_BINDING_2D_MULTISAMPLE};

// Whatever would keep a full-screen triangle from writing exactly its colours. Clip distances are added per context.
constexpr std::array<Enum, 12> kCapabilities = {CULL_FACE,           DEPTH_TEST,         STENCIL_TEST,
                                                COLOR_LOGIC_OP,      RASTERIZER_DISCARD, FRAMEBUFFER_SRGB,
                                                SAMPLE_MASK,         SAMPLE_COVERAGE,    SAMPLE_ALPHA_TO_COVERAGE,
                                                SAMPLE_ALPHA_TO_ONE, POLYGON_SMOOTH,     DITHER};

constexpr std::array<Enum, 16> kPixelStorage = {
    UNPACK_SWAP_BYTES,  UNPACK_LSB_FIRST,    UNPACK_ROW_LENGTH, UNPACK_SKIP_ROWS, UNPACK_SKIP_PIXELS, UNPACK_ALIGNMENT,
    UNPACK_SKIP_IMAGES, UNPACK_IMAGE_HEIGHT, PACK_SWAP_BYTES,   PACK_LSB_FIRST,   PACK_ROW_LENGTH,    PACK_SKIP_ROWS,
    PACK_SKIP_PIXELS,   PACK_ALIGNMENT,      PACK_SKIP_IMAGES,  PACK_IMAGE_HEIGHT};

Int integer(const Functions& gl, Enum name) {
  Int value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

std::vector<Enum> capabilitiesOf(const Functions& gl) {
  std::vector<Enum> list(kCapabilities.begin(), kCapabilities.end());
  for (Int i = 0; i < integer(gl, MAX_CLIP_DISTANCES); ++i)
    list.push_back(CLIP_DISTANCE0 + static_cast<Enum>(i));
  return list;
}

void setCapability(const Functions& gl, Enum capability, Boolean on) { (on ? gl.Enable : gl.Disable)(capability); }

bool hasIndexedBlending(const Functions& gl) {
  return gl.version >= 40 && gl.BlendFuncSeparatei && gl.BlendEquationSeparatei;
}

bool hasViewportArray(const Functions& gl) { return gl.version >= 41 && gl.ViewportIndexedf && gl.GetFloati_v; }

} // namespace

StateGuard::StateGuard(const Functions& gl) : gl_(gl) {
  program_ = integer(gl, CURRENT_PROGRAM);
  vertexArray_ = integer(gl, VERTEX_ARRAY_BINDING);
  framebuffer_ = integer(gl, DRAW_FRAMEBUFFER_BINDING);
  packBuffer_ = integer(gl, PIXEL_PACK_BUFFER_BINDING);
  unpackBuffer_ = integer(gl, PIXEL_UNPACK_BUFFER_BINDING);
  uniformBuffer_ = integer(gl, UNIFORM_BUFFER_BINDING);
  renderbuffer_ = integer(gl, RENDERBUFFER_BINDING);
  for (std::size_t i = 0; i < kPixelStorage.size(); ++i)
    pixelStorage_[i] = integer(gl, kPixelStorage[i]);
  gl.GetIntegerv(POLYGON_MODE, polygonMode_.data());
  if (gl.ClipControl) clipControl_ = {integer(gl, CLIP_ORIGIN), integer(gl, CLIP_DEPTH_MODE)};
  for (std::size_t i = 0; i < uniformBindings_.size(); ++i) {
    const auto index = static_cast<Uint>(i);
    gl.GetIntegeri_v(UNIFORM_BUFFER_BINDING, index, &uniformBindings_[i].buffer);
    gl.GetInteger64i_v(UNIFORM_BUFFER_START, index, &uniformBindings_[i].start);
    gl.GetInteger64i_v(UNIFORM_BUFFER_SIZE, index, &uniformBindings_[i].size);
  }
  for (const Enum capability : capabilitiesOf(gl))
    capabilities_.push_back(gl.IsEnabled(capability));
  saveTextures();
  saveDrawBuffers();
  saveViewports();
  saveStencil();
  setDefaults();
}

StateGuard::~StateGuard() {
  // Under active transform feedback GL refuses even the same.
  if (integer(gl_, CURRENT_PROGRAM) != program_) gl_.UseProgram(static_cast<Uint>(program_));
  gl_.BindVertexArray(static_cast<Uint>(vertexArray_));
  gl_.BindFramebuffer(DRAW_FRAMEBUFFER, static_cast<Uint>(framebuffer_));
  gl_.BindRenderbuffer(RENDERBUFFER, static_cast<Uint>(renderbuffer_));
  gl_.BindBuffer(PIXEL_PACK_BUFFER, static_cast<Uint>(packBuffer_));
  gl_.BindBuffer(PIXEL_UNPACK_BUFFER, static_cast<Uint>(unpackBuffer_));
  for (std::size_t i = 0; i < kPixelStorage.size(); ++i)
    gl_.PixelStorei(kPixelStorage[i], pixelStorage_[i]);
  for (std::size_t i = 0; i < uniformBindings_.size(); ++i) {
    const UniformBinding& binding = uniformBindings_[i];
    const auto index = static_cast<Uint>(i);
    const auto buffer = static_cast<Uint>(binding.buffer);
    if (binding.size > 0)
      gl_.BindBufferRange(UNIFORM_BUFFER, index, buffer, binding.start, binding.size);
    else
      gl_.BindBufferBase(UNIFORM_BUFFER, index, buffer);
  }
  gl_.BindBuffer(UNIFORM_BUFFER, static_cast<Uint>(uniformBuffer_)); // after the indexed ones: they bind it too
  gl_.PolygonMode(FRONT_AND_BACK, static_cast<Enum>(polygonMode_[0]));
  if (gl_.ClipControl) gl_.ClipControl(static_cast<Enum>(clipControl_[0]), static_cast<Enum>(clipControl_[1]));
  std::size_t at = 0;
  for (const Enum capability : capabilitiesOf(gl_))
    setCapability(gl_, capability, capabilities_[at++]);
  restoreTextures();
  restoreDrawBuffers();
  restoreViewports();
  restoreStencil();
}

void StateGuard::saveStencil() {
  stencil_[0] = {integer(gl_, STENCIL_FUNC),           integer(gl_, STENCIL_REF),
                 integer(gl_, STENCIL_VALUE_MASK),     integer(gl_, STENCIL_WRITEMASK),
                 integer(gl_, STENCIL_FAIL),           integer(gl_, STENCIL_PASS_DEPTH_FAIL),
                 integer(gl_, STENCIL_PASS_DEPTH_PASS)};
  stencil_[1] = {integer(gl_, STENCIL_BACK_FUNC),           integer(gl_, STENCIL_BACK_REF),
                 integer(gl_, STENCIL_BACK_VALUE_MASK),     integer(gl_, STENCIL_BACK_WRITEMASK),
                 integer(gl_, STENCIL_BACK_FAIL),           integer(gl_, STENCIL_BACK_PASS_DEPTH_FAIL),
                 integer(gl_, STENCIL_BACK_PASS_DEPTH_PASS)};
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

void StateGuard::saveTextures() {
  activeUnit_ = integer(gl_, ACTIVE_TEXTURE);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    gl_.ActiveTexture(TEXTURE0 + static_cast<Enum>(i));
    for (std::size_t t = 0; t < kTargets.size(); ++t)
      units_[i].textures[t] = integer(gl_, kTargetBindings[t]);
    units_[i].sampler = integer(gl_, SAMPLER_BINDING);
  }
}

void StateGuard::restoreTextures() const {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    gl_.ActiveTexture(TEXTURE0 + static_cast<Enum>(i));
    for (std::size_t t = 0; t < kTargets.size(); ++t)
      gl_.BindTexture(kTargets[t], static_cast<Uint>(units_[i].textures[t]));
    gl_.BindSampler(static_cast<Uint>(i), static_cast<Uint>(units_[i].sampler));
  }
  gl_.ActiveTexture(static_cast<Enum>(activeUnit_));
}

void StateGuard::saveDrawBuffers() {
  drawBuffers_.resize(static_cast<std::size_t>(integer(gl_, MAX_DRAW_BUFFERS)));
  constexpr std::array<Enum, 4> kFactors = {BLEND_SRC_RGB, BLEND_DST_RGB, BLEND_SRC_ALPHA, BLEND_DST_ALPHA};
  constexpr std::array<Enum, 2> kEquations = {BLEND_EQUATION_RGB, BLEND_EQUATION_ALPHA};
  const bool indexed = hasIndexedBlending(gl_);
  for (std::size_t i = 0; i < drawBuffers_.size(); ++i) {
    DrawBuffer& buffer = drawBuffers_[i];
    const auto index = static_cast<Uint>(i);
    buffer.blend = gl_.IsEnabledi(BLEND, index);
    gl_.GetBooleani_v(COLOR_WRITEMASK, index, buffer.mask.data());
    const auto save = [&](Enum name, Int* value) {
      if (indexed)
        gl_.GetIntegeri_v(name, index, value);
      else
        gl_.GetIntegerv(name, value);
    };
    for (std::size_t k = 0; k < kFactors.size(); ++k)
      save(kFactors[k], &buffer.factors[k]);
    for (std::size_t k = 0; k < kEquations.size(); ++k)
      save(kEquations[k], &buffer.equations[k]);
  }
}

void StateGuard::restoreDrawBuffers() const {
  const bool indexed = hasIndexedBlending(gl_);
  for (std::size_t i = 0; i < drawBuffers_.size(); ++i) {
    const DrawBuffer& buffer = drawBuffers_[i];
    const auto index = static_cast<Uint>(i);
    (buffer.blend ? gl_.Enablei : gl_.Disablei)(BLEND, index);
    gl_.ColorMaski(index, buffer.mask[0], buffer.mask[1], buffer.mask[2], buffer.mask[3]);
    const auto factor = [&](std::size_t k) { return static_cast<Enum>(buffer.factors[k]); };
    const auto equation = [&](std::size_t k) { return static_cast<Enum>(buffer.equations[k]); };
    if (indexed) {
      gl_.BlendFuncSeparatei(index, factor(0), factor(1), factor(2), factor(3));
      gl_.BlendEquationSeparatei(index, equation(0), equation(1));
    } else if (i == 0) {
      gl_.BlendFuncSeparate(factor(0), factor(1), factor(2), factor(3));
      gl_.BlendEquationSeparate(equation(0), equation(1));
    }
  }
}

void StateGuard::saveViewports() {
  const bool indexed = hasViewportArray(gl_);
  views_.resize(indexed ? static_cast<std::size_t>(integer(gl_, MAX_VIEWPORTS)) : 1);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (indexed) {
      gl_.GetFloati_v(VIEWPORT, static_cast<Uint>(i), views_[i].rectangle.data());
      views_[i].scissor = gl_.IsEnabledi(SCISSOR_TEST, static_cast<Uint>(i));
    } else {
      std::array<Int, 4> rectangle{};
      gl_.GetIntegerv(VIEWPORT, rectangle.data());
      for (std::size_t k = 0; k < 4; ++k)
        views_[i].rectangle[k] = static_cast<Float>(rectangle[k]);
      views_[i].scissor = gl_.IsEnabled(SCISSOR_TEST);
    }
  }
}

void StateGuard::restoreViewports() const {
  const bool indexed = hasViewportArray(gl_);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const auto& r = views_[i].rectangle;
    if (indexed) {
      gl_.ViewportIndexedf(static_cast<Uint>(i), r[0], r[1], r[2], r[3]);
      (views_[i].scissor ? gl_.Enablei : gl_.Disablei)(SCISSOR_TEST, static_cast<Uint>(i));
    } else {
      gl_.Viewport(static_cast<Int>(r[0]), static_cast<Int>(r[1]), static_cast<Sizei>(r[2]), static_cast<Sizei>(r[3]));
      setCapability(gl_, SCISSOR_TEST, views_[i].scissor);
    }
  }
}

void StateGuard::setDefaults() const {
  for (const Enum capability : capabilitiesOf(gl_))
    gl_.Disable(capability);
  gl_.Disable(SCISSOR_TEST);
  gl_.Disable(BLEND);
  gl_.PolygonMode(FRONT_AND_BACK, FILL);
  if (gl_.ClipControl) gl_.ClipControl(LOWER_LEFT, NEGATIVE_ONE_TO_ONE); // strips and tiles are placed by clip-space y
  gl_.BindBuffer(PIXEL_PACK_BUFFER, 0);
  gl_.BindBuffer(PIXEL_UNPACK_BUFFER, 0);
  for (const Enum parameter : kPixelStorage)
    gl_.PixelStorei(parameter, parameter == UNPACK_ALIGNMENT || parameter == PACK_ALIGNMENT ? 4 : 0);
  for (std::size_t i = 0; i < drawBuffers_.size(); ++i)
    gl_.ColorMaski(static_cast<Uint>(i), 1, 1, 1, 1);
}

} // namespace tyndall::gl
