#include "GlState.h"

#include "LegacyState.h"
#include "support/TestContext.h"

#include <algorithm>

namespace tests {

using host::gl;

namespace {

constexpr int kUnits = 32; // of textures: more than the effect has

void addIntegers(GlState& state, const std::string& name, GLenum query, int count = 1) {
  std::vector<GLint> values(static_cast<std::size_t>(std::max(count, 4)));
  gl().GetIntegerv(query, values.data());
  state[name].assign(values.begin(), values.begin() + count);
}

void addIndexed(GlState& state, const std::string& name, GLenum query, int index) {
  GLint values[4] = {};
  gl().GetIntegeri_v(query, static_cast<GLuint>(index), values);
  state[name + "[" + std::to_string(index) + "]"] = {static_cast<double>(values[0])};
}

const std::map<std::string, GLenum> kCapabilities = {
    {"blend", GL_BLEND},
    {"cull face", GL_CULL_FACE},
    {"depth test", GL_DEPTH_TEST},
    {"stencil test", GL_STENCIL_TEST},
    {"scissor test", GL_SCISSOR_TEST},
    {"dither", GL_DITHER},
    {"logic op", GL_COLOR_LOGIC_OP},
    {"rasterizer discard", GL_RASTERIZER_DISCARD},
    {"framebuffer sRGB", GL_FRAMEBUFFER_SRGB},
    {"multisample", GL_MULTISAMPLE},
    {"sample mask", GL_SAMPLE_MASK},
    {"sample coverage", GL_SAMPLE_COVERAGE},
    {"alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE},
    {"alpha to one", GL_SAMPLE_ALPHA_TO_ONE},
    {"polygon smooth", GL_POLYGON_SMOOTH},
    {"polygon offset", GL_POLYGON_OFFSET_FILL},
    {"depth clamp", GL_DEPTH_CLAMP},
    {"primitive restart", GL_PRIMITIVE_RESTART},
    {"clip distance 0", GL_CLIP_DISTANCE0},
    {"clip distance 7", GL_CLIP_DISTANCE7},
};

const std::map<std::string, GLenum> kIntegers = {
    {"program", GL_CURRENT_PROGRAM},
    {"vertex array", GL_VERTEX_ARRAY_BINDING},
    {"array buffer", GL_ARRAY_BUFFER_BINDING},
    {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
    {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
    {"renderbuffer", GL_RENDERBUFFER_BINDING},
    {"pixel unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
    {"pixel pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
    {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
    {"active texture", GL_ACTIVE_TEXTURE},
    {"depth func", GL_DEPTH_FUNC},
    {"depth mask", GL_DEPTH_WRITEMASK},
    {"stencil func", GL_STENCIL_FUNC},
    {"stencil ref", GL_STENCIL_REF},
    {"stencil value mask", GL_STENCIL_VALUE_MASK},
    {"stencil write mask", GL_STENCIL_WRITEMASK},
    {"stencil fail", GL_STENCIL_FAIL},
    {"stencil pass", GL_STENCIL_PASS_DEPTH_PASS},
    {"stencil back func", GL_STENCIL_BACK_FUNC},
    {"stencil back ref", GL_STENCIL_BACK_REF},
    {"stencil back value mask", GL_STENCIL_BACK_VALUE_MASK},
    {"stencil back write mask", GL_STENCIL_BACK_WRITEMASK},
    {"stencil back fail", GL_STENCIL_BACK_FAIL},
    {"stencil back pass", GL_STENCIL_BACK_PASS_DEPTH_PASS},
    {"stencil depth fail", GL_STENCIL_PASS_DEPTH_FAIL},
    {"pack skip pixels", GL_PACK_SKIP_PIXELS},
    {"pack swap bytes", GL_PACK_SWAP_BYTES},
    {"pack alignment", GL_PACK_ALIGNMENT},
    {"unpack skip rows", GL_UNPACK_SKIP_ROWS},
    {"unpack skip pixels", GL_UNPACK_SKIP_PIXELS},
    {"unpack swap bytes", GL_UNPACK_SWAP_BYTES},
    {"cull mode", GL_CULL_FACE_MODE},
    {"front face", GL_FRONT_FACE},
    {"polygon mode", GL_POLYGON_MODE},
    {"logic op mode", GL_LOGIC_OP_MODE},
    {"unpack alignment", GL_UNPACK_ALIGNMENT},
    {"unpack row length", GL_UNPACK_ROW_LENGTH},
    {"unpack LSB first", GL_UNPACK_LSB_FIRST},
    {"unpack skip images", GL_UNPACK_SKIP_IMAGES},
    {"unpack image height", GL_UNPACK_IMAGE_HEIGHT},
    {"pack row length", GL_PACK_ROW_LENGTH},
    {"pack skip rows", GL_PACK_SKIP_ROWS},
    {"pack LSB first", GL_PACK_LSB_FIRST},
    {"pack skip images", GL_PACK_SKIP_IMAGES},
    {"pack image height", GL_PACK_IMAGE_HEIGHT},
    {"stencil clear value", GL_STENCIL_CLEAR_VALUE},
    {"primitive restart index", GL_PRIMITIVE_RESTART_INDEX},
    {"transform feedback buffer", GL_TRANSFORM_FEEDBACK_BUFFER_BINDING},
    {"provoking vertex", GL_PROVOKING_VERTEX},
};

void addStorage(GlState& state) {
  addIntegers(state, "shader storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING);
  addIntegers(state, "copy read buffer", GL_COPY_READ_BUFFER_BINDING);
  addIntegers(state, "copy write buffer", GL_COPY_WRITE_BUFFER_BINDING);
  for (int i = 0; i < 8; ++i) {
    for (const GLenum query :
         {GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE})
      addIndexed(state, "storage binding " + std::to_string(query), query, i);
    for (const GLenum query : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED,
                               GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT})
      addIndexed(state, "image " + std::to_string(query), query, i);
  }
}

} // namespace

GlState captureGlState() {
  GlState state;
  for (const auto& [name, capability] : kCapabilities)
    state[name] = {static_cast<double>(gl().IsEnabled(capability))};
  for (const auto& [name, query] : kIntegers)
    addIntegers(state, name, query);
  addIntegers(state, "viewport", GL_VIEWPORT, 4);
  addIntegers(state, "scissor box", GL_SCISSOR_BOX, 4);
  if (testContext().glVersion() >= 41) addIntegers(state, "program pipeline", GL_PROGRAM_PIPELINE_BINDING);
  if (testContext().glVersion() >= 45) {
    addIntegers(state, "clip origin", GL_CLIP_ORIGIN);
    addIntegers(state, "clip depth mode", GL_CLIP_DEPTH_MODE);
  }
  for (const auto& [name, query] :
       std::map<std::string, GLenum>{{"clear colour", GL_COLOR_CLEAR_VALUE}, {"blend colour", GL_BLEND_COLOR}}) {
    GLfloat values[4];
    gl().GetFloatv(query, values);
    state[name].assign(values, values + 4);
  }
  GLint drawBuffers = 0;
  gl().GetIntegerv(GL_MAX_DRAW_BUFFERS, &drawBuffers);
  for (int i = 0; i < drawBuffers; ++i) {
    const std::string suffix = "[" + std::to_string(i) + "]";
    GLboolean mask[4];
    gl().GetBooleani_v(GL_COLOR_WRITEMASK, static_cast<GLuint>(i), mask);
    state["colour mask" + suffix].assign(mask, mask + 4);
    state["blend" + suffix] = {static_cast<double>(gl().IsEnabledi(GL_BLEND, static_cast<GLuint>(i)))};
    if (testContext().glVersion() < 40) continue;
    for (const GLenum query : {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA,
                               GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA})
      addIndexed(state, "blend " + std::to_string(query), query, i);
  }
  for (const GLenum query : {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA,
                             GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA})
    addIntegers(state, "blend " + std::to_string(query), query);
  if (testContext().glVersion() >= 41)
    for (GLuint i = 0; i < 16; ++i) {
      GLfloat v[4];
      gl().GetFloati_v(GL_VIEWPORT, i, v);
      state["viewport[" + std::to_string(i) + "]"].assign(v, v + 4);
      state["scissor[" + std::to_string(i) + "]"] = {static_cast<double>(gl().IsEnabledi(GL_SCISSOR_TEST, i))};
    }
  GLint active = 0;
  gl().GetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (int unit = 0; unit < kUnits; ++unit) {
    gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    for (const GLenum query :
         {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
          GL_TEXTURE_BINDING_CUBE_MAP, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_BUFFER, GL_SAMPLER_BINDING})
      addIntegers(state, "unit " + std::to_string(unit) + " " + std::to_string(query), query);
    if (testContext().glVersion() >= 40)
      addIntegers(state, "unit " + std::to_string(unit) + " cube array", GL_TEXTURE_BINDING_CUBE_MAP_ARRAY);
  }
  gl().ActiveTexture(static_cast<GLenum>(active));
  for (int i = 0; i < 8; ++i)
    for (const GLenum query : {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE})
      addIndexed(state, "uniform binding " + std::to_string(query), query, i);
  if (testContext().glVersion() >= 43) addStorage(state);
  addLegacyState(state);
  return state;
}

Poison::Poison() {
  const GladGLContext& g = gl();
  poisonLegacyState();
  program.use();
  g.BindVertexArray(vertexArray.name());
  g.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  g.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.name(), 0);
  for (const auto& entry : kCapabilities)
    if (entry.second != GL_DITHER && entry.second != GL_MULTISAMPLE) g.Enable(entry.second);
  g.Disable(GL_DITHER);
  for (GLuint i = 0; i < 4; ++i)
    (i % 2 ? g.Enablei : g.Disablei)(GL_BLEND, i);
  g.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  g.ColorMaski(1, GL_TRUE, GL_FALSE, GL_FALSE, GL_FALSE);
  g.BlendFuncSeparate(GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR);
  g.BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
  if (g.BlendFuncSeparatei) {
    g.BlendFuncSeparatei(1, GL_ZERO, GL_SRC_COLOR, GL_ONE, GL_DST_ALPHA);
    g.BlendEquationSeparatei(1, GL_MIN, GL_FUNC_SUBTRACT);
  }
  g.Viewport(1, 2, 3, 5);
  g.Scissor(1, 1, 2, 2);
  if (g.ViewportIndexedf) {
    g.ViewportIndexedf(3, 0.5F, 0.25F, 7.5F, 6.5F);
    g.Disablei(GL_SCISSOR_TEST, 2);
  }
  g.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  if (testContext().glVersion() >= 45) g.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
  g.LogicOp(GL_XOR);
  g.DepthFunc(GL_NEVER);
  g.DepthMask(GL_FALSE);
  g.StencilFunc(GL_NEVER, 3, 0x55);
  g.StencilMask(0x3);
  g.StencilFuncSeparate(GL_BACK, GL_GREATER, 7, 0x33);
  g.StencilMaskSeparate(GL_BACK, 0x70);
  g.StencilOpSeparate(GL_FRONT, GL_INCR, GL_ZERO, GL_INVERT);
  g.StencilOpSeparate(GL_BACK, GL_DECR, GL_INCR_WRAP, GL_REPLACE);
  g.PixelStorei(GL_PACK_SKIP_PIXELS, 5);
  g.PixelStorei(GL_PACK_SWAP_BYTES, GL_TRUE);
  g.PixelStorei(GL_PACK_ALIGNMENT, 1);
  g.PixelStorei(GL_UNPACK_SKIP_ROWS, 2);
  g.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  g.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  g.PixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  g.CullFace(GL_FRONT_AND_BACK);
  g.FrontFace(GL_CW);
  g.ClearColor(1, 2, 3, 4);
  g.PixelStorei(GL_UNPACK_ROW_LENGTH, 17);
  g.BindBuffer(GL_ARRAY_BUFFER, vertices.name());
  g.BindBuffer(GL_UNIFORM_BUFFER, uniforms.name());
  g.BufferData(GL_UNIFORM_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  g.BindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms.name());
  g.BindBufferRange(GL_UNIFORM_BUFFER, 1, uniforms.name(), 1024, 512);
  g.BindBuffer(GL_UNIFORM_BUFFER, 0);
  for (int unit = 0; unit < kUnits; ++unit) {
    g.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    textures.push_back(host::makeTexture2D(GL_R8, 1, 1));
    textures.push_back(host::makeTextureArray(GL_R8, 1, 1, 2));
    textures.push_back(host::makeTexture2DMultisample(GL_RGBA8, 1, 1, 4));
    textures.push_back(host::makeTexture());
    g.BindTexture(GL_TEXTURE_3D, textures.back().name());
    samplers.push_back(host::makeSampler());
    g.BindSampler(static_cast<GLuint>(unit), samplers.back().name());
  }
  g.ActiveTexture(GL_TEXTURE5);
  g.BindBuffer(GL_PIXEL_UNPACK_BUFFER, unpack.name());
  g.BindBuffer(GL_PIXEL_PACK_BUFFER, pack.name());
  if (testContext().glVersion() < 43) return;
  g.BindBuffer(GL_SHADER_STORAGE_BUFFER, storage.name());
  g.BufferData(GL_SHADER_STORAGE_BUFFER, 8192, nullptr, GL_STATIC_DRAW);
  for (GLuint i = 0; i < 4; ++i) {
    g.BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, storage.name(), 1024 * static_cast<GLintptr>(i), 512);
    g.BindImageTexture(i, target.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA16F);
  }
  g.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, storage.name());
  g.BindBuffer(GL_SHADER_STORAGE_BUFFER, vertices.name());
  g.BindBuffer(GL_COPY_READ_BUFFER, uniforms.name());
  g.BindBuffer(GL_COPY_WRITE_BUFFER, vertices.name());
}

void Poison::lift() {
  const GladGLContext& g = gl();
  for (const auto& entry : kCapabilities)
    g.Disable(entry.second);
  g.Enable(GL_DITHER);
  g.Enable(GL_MULTISAMPLE);
  g.UseProgram(0);
  g.BindVertexArray(0);
  g.BindFramebuffer(GL_FRAMEBUFFER, 0);
  g.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  g.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  if (testContext().glVersion() >= 45) g.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  g.DepthFunc(GL_LESS);
  g.DepthMask(GL_TRUE);
  g.StencilFunc(GL_ALWAYS, 0, ~0U);
  g.StencilMask(~0U);
  g.CullFace(GL_BACK);
  g.FrontFace(GL_CCW);
  g.BlendEquation(GL_FUNC_ADD);
  g.BlendFunc(GL_ONE, GL_ZERO);
  for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES,
                            GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})
    g.PixelStorei(name, 0);
  g.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  g.PixelStorei(GL_PACK_ALIGNMENT, 4);
  g.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  g.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  g.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  for (GLuint unit = 0; unit < kUnits; ++unit)
    g.BindSampler(unit, 0);
  g.ActiveTexture(GL_TEXTURE0);
  leaveCleanLegacyState();
  if (testContext().glVersion() < 43) return;
  g.BindBuffer(GL_COPY_READ_BUFFER, 0);
  g.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
  for (GLuint i = 0; i < 4; ++i) {
    g.BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
    g.BindImageTexture(i, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32F);
  }
}

std::vector<int> liveGlObjects() {
  const GladGLContext& g = gl();
  std::vector<int> counts;
  for (const auto is :
       {g.IsTexture, g.IsBuffer, g.IsFramebuffer, g.IsVertexArray, g.IsSampler, g.IsQuery, g.IsProgram, g.IsShader}) {
    counts.push_back(0);
    for (GLuint name = 1; name < 4096; ++name)
      counts.back() += is(name) ? 1 : 0;
  }
  return counts;
}

} // namespace tests
