#include "HostileRows.h"

#include "LegacyState.h"
#include "support/TestContext.h"

#include <array>

using namespace tyndall;
using host::gl;

namespace tests {

namespace {

using Rows = std::vector<HostileRow>;
using Engine = HostileEngine;

int integer(GLenum name) {
  GLint value = 0;
  gl().GetIntegerv(name, &value);
  return value;
}

HostileRow enabled(const std::string& name, GLenum capability, const std::function<void()>& more = {}) {
  return {name, [=](Engine&) {
            gl().Enable(capability);
            if (more) more();
          }};
}

// --- what reaches fragments

void addRasterisation(Rows& rows) {
  rows.push_back({"clip origin upper left", [](Engine&) { gl().ClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE); },
                  Where::Everywhere, 45});
  rows.push_back({"clip depth zero to one", [](Engine&) { gl().ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); },
                  Where::Everywhere, 45});
  rows.push_back({"clip origin upper left, depth zero to one",
                  [](Engine&) { gl().ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE); }, Where::Once, 45});
  for (const GLenum face : {GL_FRONT, GL_BACK, GL_FRONT_AND_BACK})
    for (const GLenum front : {GL_CW, GL_CCW})
      rows.push_back(
          enabled("faces culled: " + std::to_string(face) + ", front " + std::to_string(front), GL_CULL_FACE, [=] {
            gl().CullFace(face);
            gl().FrontFace(front);
          }));
  rows.push_back({"polygons as lines", [](Engine&) { gl().PolygonMode(GL_FRONT_AND_BACK, GL_LINE); }});
  rows.push_back({"polygons as points", [](Engine&) { gl().PolygonMode(GL_FRONT_AND_BACK, GL_POINT); }});
  rows.push_back(enabled("polygon offset", GL_POLYGON_OFFSET_FILL, [] { gl().PolygonOffset(1e6F, 1e6F); }));
  rows.push_back(enabled("smooth polygons", GL_POLYGON_SMOOTH, [] { gl().Enable(GL_LINE_SMOOTH); }));
  rows.push_back(enabled("no rasterisation", GL_RASTERIZER_DISCARD));
  rows.push_back(enabled("depth clamp", GL_DEPTH_CLAMP, [] { gl().DepthRange(0.75, 0.25); }));
  rows.push_back({"depth range reversed", [](Engine&) { gl().DepthRange(1, 0); }});
  rows.push_back({"clip distances", [](Engine&) {
                    for (int i = 0; i < integer(GL_MAX_CLIP_DISTANCES); ++i)
                      gl().Enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
                  }});
  rows.push_back(enabled("point size by program", GL_PROGRAM_POINT_SIZE, [] { gl().PointSize(17); }));
  rows.push_back(enabled("primitive restart at 0", GL_PRIMITIVE_RESTART, [] { gl().PrimitiveRestartIndex(0); }));
  rows.push_back(enabled("primitive restart at 2", GL_PRIMITIVE_RESTART, [] { gl().PrimitiveRestartIndex(2); }));
  rows.push_back({"primitive restart at the fixed index",
                  [](Engine&) { gl().Enable(GL_PRIMITIVE_RESTART_FIXED_INDEX); }, Where::Once, 43});
  rows.push_back({"first vertex provokes", [](Engine&) { gl().ProvokingVertex(GL_FIRST_VERTEX_CONVENTION); }});
  rows.push_back(
      {"patches of 7 vertices", [](Engine&) { gl().PatchParameteri(GL_PATCH_VERTICES, 7); }, Where::Once, 40});
  rows.push_back({"viewport of one pixel", [](Engine&) { gl().Viewport(5, 7, 1, 1); }});
  rows.push_back({"sixteen viewports and scissors",
                  [](Engine&) {
                    for (GLuint i = 0; i < 16; ++i) {
                      gl().ViewportIndexedf(i, 0.25F * static_cast<float>(i), -3.5F, 7.75F, 3.5F);
                      gl().ScissorIndexed(i, static_cast<GLint>(i), 2, 3, 1);
                      gl().DepthRangeIndexed(i, 0.9, 0.1);
                      gl().Enablei(GL_SCISSOR_TEST, i);
                    }
                  },
                  Where::Everywhere, 41});
  rows.push_back({"hints", [](Engine&) {
                    for (const GLenum hint : {GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_POLYGON_SMOOTH_HINT})
                      gl().Hint(hint, GL_FASTEST);
                  }});
}

// --- what is done to fragments

void addFragmentTests(Rows& rows) {
  rows.push_back(enabled("scissor", GL_SCISSOR_TEST, [] { gl().Scissor(9, 9, 2, 2); }));
  rows.push_back(enabled("depth test that fails", GL_DEPTH_TEST, [] {
    gl().DepthFunc(GL_NEVER);
    gl().DepthMask(GL_FALSE);
  }));
  rows.push_back({"stencil test that fails",
                  [](Engine&) {
                    gl().Enable(GL_STENCIL_TEST);
                    gl().StencilFuncSeparate(GL_FRONT, GL_NEVER, 3, 0x55);
                    gl().StencilFuncSeparate(GL_BACK, GL_GREATER, 7, 0x33);
                    gl().StencilOpSeparate(GL_FRONT, GL_INCR, GL_ZERO, GL_INVERT);
                    gl().StencilOpSeparate(GL_BACK, GL_DECR, GL_INCR_WRAP, GL_REPLACE);
                    gl().StencilMaskSeparate(GL_FRONT, 0x3);
                    gl().StencilMaskSeparate(GL_BACK, 0);
                    gl().ClearStencil(5);
                  },
                  Where::Everywhere});
  rows.push_back(enabled("sample mask of nothing", GL_SAMPLE_MASK, [] { gl().SampleMaski(0, 0); }));
  rows.push_back(enabled("sample coverage of nothing", GL_SAMPLE_COVERAGE, [] { gl().SampleCoverage(0, GL_FALSE); }));
  rows.push_back(enabled("alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE));
  rows.push_back(enabled("alpha to one", GL_SAMPLE_ALPHA_TO_ONE));
  rows.push_back({"shading by sample",
                  [](Engine&) {
                    gl().Enable(GL_SAMPLE_SHADING);
                    gl().MinSampleShading(1);
                  },
                  Where::Once, 40});
  rows.push_back({"no multisampling", [](Engine&) { gl().Disable(GL_MULTISAMPLE); }});
  rows.push_back({"no dither", [](Engine&) { gl().Disable(GL_DITHER); }});
  rows.push_back(enabled("sRGB framebuffers", GL_FRAMEBUFFER_SRGB));
  rows.push_back(enabled("logic operation", GL_COLOR_LOGIC_OP, [] { gl().LogicOp(GL_XOR); }));
}

void addBlending(Rows& rows) {
  rows.push_back(enabled("blending, subtracted", GL_BLEND, [] {
    gl().BlendFuncSeparate(GL_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR);
    gl().BlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    gl().BlendColor(0.1F, 0.2F, 0.3F, 0.4F);
  }));
  rows.push_back(enabled("blending with two sources", GL_BLEND, [] {
    gl().BlendFuncSeparate(GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR, GL_SRC1_ALPHA, GL_ONE_MINUS_SRC1_ALPHA);
  }));
  rows.push_back({"blending, another for each buffer",
                  [](Engine&) {
                    for (GLuint i = 0; i < 8; ++i) {
                      (i % 2 ? gl().Enablei : gl().Disablei)(GL_BLEND, i);
                      gl().BlendFuncSeparatei(i, GL_ZERO, i % 3 ? GL_SRC_COLOR : GL_ZERO, GL_ONE, GL_DST_ALPHA);
                      gl().BlendEquationSeparatei(i, i % 2 ? GL_MIN : GL_FUNC_SUBTRACT, GL_MAX);
                    }
                  },
                  Where::Everywhere, 40});
  rows.push_back({"no colour written", [](Engine&) { gl().ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE); },
                  Where::Everywhere});
  rows.push_back({"a colour mask for each buffer", [](Engine&) {
                    for (GLuint i = 0; i < 8; ++i)
                      gl().ColorMaski(i, i & 1, i & 2, i & 4, GL_FALSE);
                  }});
  rows.push_back({"clear values", [](Engine&) {
                    gl().ClearColor(1, 2, 3, 4);
                    gl().ClearDepth(0.3);
                    gl().ClearStencil(0x7F);
                  }});
}

// --- what is bound

void bindTextures(Engine& engine) {
  constexpr std::array<GLenum, 6> kMore = {GL_TEXTURE_1D,       GL_TEXTURE_3D,        GL_TEXTURE_CUBE_MAP,
                                           GL_TEXTURE_1D_ARRAY, GL_TEXTURE_RECTANGLE, GL_TEXTURE_BUFFER};
  for (int unit = 0; unit < 32; ++unit) {
    gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    engine.textures.push_back(host::makeTexture2D(GL_R8, 1, 1));
    engine.textures.push_back(host::makeTextureArray(GL_R8, 1, 1, 2));
    engine.textures.push_back(host::makeTexture2DMultisample(GL_RGBA8, 1, 1, 4));
    for (const GLenum target : kMore) {
      engine.textures.push_back(host::makeTexture());
      gl().BindTexture(target, engine.textures.back().name());
    }
  }
}

void bindSamplers(Engine& engine) {
  for (GLuint unit = 0; unit < 32; ++unit) {
    engine.samplers.push_back(host::makeSampler());
    const GLuint sampler = engine.samplers.back().name();
    gl().SamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl().SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl().SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl().SamplerParameterf(sampler, GL_TEXTURE_MIN_LOD, 3);
    gl().BindSampler(unit, sampler);
  }
}

void bindBuffers(Engine& engine) {
  const auto make = [&](GLenum target, GLsizeiptr size) {
    engine.buffers.push_back(host::makeBuffer());
    gl().BindBuffer(target, engine.buffers.back().name());
    gl().BufferData(target, size, nullptr, GL_STATIC_DRAW);
    return engine.buffers.back().name();
  };
  const GLuint uniforms = make(GL_UNIFORM_BUFFER, 4096);
  gl().BindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms);
  gl().BindBufferRange(GL_UNIFORM_BUFFER, 1, uniforms, 1024, 512);
  gl().BindBufferRange(GL_UNIFORM_BUFFER, 2, uniforms, 2048, 16);
  for (const GLenum target : {GL_ARRAY_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_TEXTURE_BUFFER})
    make(target, 16);
}

void bindStorage(Engine& engine) {
  engine.buffers.push_back(host::makeBuffer());
  gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, engine.buffers.back().name());
  gl().BufferData(GL_SHADER_STORAGE_BUFFER, 8192, nullptr, GL_STATIC_DRAW);
  engine.textures.push_back(host::makeTexture2D(GL_RGBA16F, 8, 8));
  for (GLuint i = 0; i < 4; ++i) {
    gl().BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, engine.buffers.back().name(), 1024 * static_cast<GLintptr>(i),
                         512);
    gl().BindImageTexture(i, engine.textures.back().name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA16F);
  }
}

// Buffers of 4 bytes: a transfer that reads or writes one of them fails.
void bindPixelBuffers(Engine& engine) {
  for (const GLenum target : {GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER}) {
    engine.buffers.push_back(host::makeBuffer());
    gl().BindBuffer(target, engine.buffers.back().name());
    gl().BufferData(target, 4, nullptr, GL_STATIC_DRAW);
  }
}

void changePixelStorage(Engine&) {
  for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH})
    gl().PixelStorei(name, 317);
  for (const GLenum name : {GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_PACK_IMAGE_HEIGHT,
                            GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_IMAGE_HEIGHT})
    gl().PixelStorei(name, 3);
  for (const GLenum name : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
    gl().PixelStorei(name, GL_TRUE);
  gl().PixelStorei(GL_PACK_ALIGNMENT, 8);
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

const char* const kVertex = "#version 330 core\nout vec4 v;\nvoid main() { v = gl_Position = vec4(0); }";
const char* const kFragment = "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }";

void bindVertexArray(Engine& engine) {
  engine.vertexArrays.push_back(host::makeVertexArray());
  gl().BindVertexArray(engine.vertexArrays.back().name());
  engine.buffers.push_back(host::makeBuffer());
  gl().BindBuffer(GL_ARRAY_BUFFER, engine.buffers.back().name());
  gl().BufferData(GL_ARRAY_BUFFER, 4, nullptr, GL_STATIC_DRAW); // too short for any vertex
  for (GLuint i = 0; i < 8; ++i) {
    gl().VertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, 16, nullptr);
    gl().EnableVertexAttribArray(i);
    gl().VertexAttribDivisor(i, i % 3);
  }
}

void bindFramebuffers(Engine& engine, bool complete) {
  engine.textures.push_back(host::makeTexture2D(GL_RGBA8, 8, 8));
  for (const GLenum target : {GL_READ_FRAMEBUFFER, GL_DRAW_FRAMEBUFFER}) {
    engine.framebuffers.push_back(host::makeFramebuffer());
    gl().BindFramebuffer(target, engine.framebuffers.back().name());
    if (complete)
      gl().FramebufferTexture2D(target, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, engine.textures.back().name(), 0);
  }
}

void addBindings(Rows& rows) {
  rows.push_back({"textures on all units", bindTextures, Where::Everywhere});
  rows.push_back({"samplers on all units", bindSamplers, Where::Everywhere});
  rows.push_back({"the last texture unit active", [](Engine&) {
                    gl().ActiveTexture(GL_TEXTURE0 +
                                       static_cast<GLenum>(integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS) - 1));
                  }});
  rows.push_back({"uniform and other buffers", bindBuffers, Where::Everywhere});
  rows.push_back({"storage buffers and images", bindStorage, Where::Once, 43});
  rows.push_back({"pixel buffers", bindPixelBuffers, Where::Everywhere});
  rows.push_back({"pixel storage", changePixelStorage, Where::Everywhere});
  rows.push_back({"a vertex array with attributes", bindVertexArray});
  rows.push_back({"framebuffers of its own", [](Engine& e) { bindFramebuffers(e, true); }});
  rows.push_back({"framebuffers that are not complete", [](Engine& e) { bindFramebuffers(e, false); }});
  rows.push_back({"a program", [](Engine& e) {
                    e.programs.push_back(std::make_unique<host::Program>("hostile", kVertex, kFragment));
                    e.programs.back()->use();
                  }});
  rows.push_back({"a program pipeline",
                  [](Engine&) {
                    const GLuint program = gl().CreateShaderProgramv(GL_FRAGMENT_SHADER, 1, &kFragment);
                    GLuint pipeline = 0;
                    gl().GenProgramPipelines(1, &pipeline);
                    gl().UseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, program);
                    gl().BindProgramPipeline(pipeline);
                    gl().DeleteProgram(program);
                  },
                  Where::Once,
                  41,
                  {},
                  {},
                  [] {
                    const auto pipeline = static_cast<GLuint>(integer(GL_PROGRAM_PIPELINE_BINDING));
                    gl().BindProgramPipeline(0);
                    gl().DeleteProgramPipelines(1, &pipeline);
                  }});
}

// --- what the engine's own textures are set to

void setParameters(GLenum target, GLuint texture, const std::vector<std::pair<GLenum, GLint>>& values) {
  if (texture == 0) return;
  gl().BindTexture(target, texture);
  for (const auto& [name, value] : values)
    gl().TexParameteri(target, name, value);
}

void changeSampling(Engine& engine) {
  const std::vector<std::pair<GLenum, GLint>> values = {{GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR},
                                                        {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                                        {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER},
                                                        {GL_TEXTURE_WRAP_T, GL_MIRRORED_REPEAT},
                                                        {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                                                        {GL_TEXTURE_COMPARE_FUNC, GL_GREATER},
                                                        {GL_TEXTURE_MIN_LOD, 3},
                                                        {GL_TEXTURE_MAX_LEVEL, 5}};
  const Frame& frame = engine.frame;
  for (const GLuint texture : {frame.colour, frame.depth.texture, frame.output.inscatter, frame.output.transmittance})
    setParameters(GL_TEXTURE_2D, texture, values);
  for (const Light& light : frame.lights)
    for (const GLuint texture : {light.shadow.texture, light.glass.colour, light.glass.depth})
      setParameters(light.shadow.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, texture, values);
}

void addTextures(Rows& rows) {
  rows.push_back({"sampling parameters of its textures", changeSampling, Where::Everywhere});
  for (const auto& [name, source] :
       {std::pair("zero", GL_ZERO), {"one", GL_ONE}, {"green", GL_GREEN}, {"alpha", GL_ALPHA}}) {
    const auto red = static_cast<GLint>(source);
    const std::string rule = ": GL_TEXTURE_SWIZZLE_R must be GL_RED";
    rows.push_back(
        {std::string("depth that gives ") + name + " as red",
         [red](Engine& e) { setParameters(GL_TEXTURE_2D, e.frame.depth.texture, {{GL_TEXTURE_SWIZZLE_R, red}}); },
         Where::Everywhere, 33, rule});
    rows.push_back({std::string("a shadow map that gives ") + name + " as red",
                    [red](Engine& e) {
                      const ShadowMap& map = e.frame.lights[0].shadow;
                      setParameters(map.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, map.texture,
                                    {{GL_TEXTURE_SWIZZLE_R, red}});
                    },
                    Where::Everywhere, 33, rule});
  }
  rows.push_back({"depth whose green, blue and alpha are swizzled",
                  [](Engine& e) {
                    setParameters(GL_TEXTURE_2D, e.frame.depth.texture,
                                  {{GL_TEXTURE_SWIZZLE_G, GL_RED},
                                   {GL_TEXTURE_SWIZZLE_B, GL_RED},
                                   {GL_TEXTURE_SWIZZLE_A, GL_ZERO}});
                  },
                  Where::Everywhere});
}

// --- what is under way

void beginFeedback(Engine& engine, bool pause) {
  static const char* const kVarying = "v";
  engine.programs.push_back(std::make_unique<host::Program>("feedback", kVertex, kFragment));
  engine.programs.back()->use();
  const auto program = static_cast<GLuint>(integer(GL_CURRENT_PROGRAM));
  gl().TransformFeedbackVaryings(program, 1, &kVarying, GL_INTERLEAVED_ATTRIBS);
  gl().LinkProgram(program);
  gl().UseProgram(program);
  engine.buffers.push_back(host::makeBuffer());
  gl().BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, engine.buffers.back().name());
  gl().BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  gl().BeginTransformFeedback(GL_TRIANGLES);
  if (pause) gl().PauseTransformFeedback();
}

HostileRow query(const std::string& name, GLenum target) {
  return {name,
          [target](Engine&) {
            GLuint query = 0;
            gl().GenQueries(1, &query);
            gl().BeginQuery(target, query);
          },
          Where::Everywhere,
          33,
          {},
          {},
          [target] {
            GLint query = 0;
            gl().GetQueryiv(target, GL_CURRENT_QUERY, &query);
            gl().EndQuery(target);
            const auto used = static_cast<GLuint>(query);
            gl().DeleteQueries(1, &used);
          }};
}

void addUnderWay(Rows& rows) {
  for (const bool paused : {false, true})
    rows.push_back({paused ? "transform feedback, paused" : "transform feedback",
                    [paused](Engine& e) { beginFeedback(e, paused); },
                    Where::Once,
                    40,
                    "transform feedback is active",
                    {},
                    [] {
                      gl().EndTransformFeedback();
                      gl().BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
                    }});
  rows.push_back(query("a query of samples", GL_SAMPLES_PASSED));
  rows.push_back(query("a query whether any sample passes", GL_ANY_SAMPLES_PASSED));
  rows.push_back(query("a query of primitives", GL_PRIMITIVES_GENERATED));
  rows.push_back(query("a query of time", GL_TIME_ELAPSED));
  rows.push_back({"a debug group",
                  [](Engine&) { gl().PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 1, -1, "engine"); },
                  Where::Once,
                  43,
                  {},
                  {},
                  [] { gl().PopDebugGroup(); }});
  rows.push_back(
      {"a GL error", [](Engine&) { gl().Enable(GL_TEXTURE_2D_ARRAY); }, Where::Everywhere, 33, {}, "GL_INVALID_ENUM"});
}

} // namespace

const std::vector<HostileRow>& hostileRows() {
  static const Rows all = [] {
    Rows rows;
    addRasterisation(rows);
    addFragmentTests(rows);
    addBlending(rows);
    addBindings(rows);
    addTextures(rows);
    addUnderWay(rows);
    addLegacyRows(rows);
    rows.push_back({"much at once", [](Engine& e) { e.poison = std::make_unique<Poison>(); }, Where::Everywhere});
    return rows;
  }();
  return all;
}

void leaveCleanState() {
  Poison::lift();
  const GladGLContext& g = gl();
  for (const GLenum capability : {GL_LINE_SMOOTH, GL_PROGRAM_POINT_SIZE})
    g.Disable(capability);
  for (int i = 0; i < integer(GL_MAX_CLIP_DISTANCES); ++i)
    g.Disable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
  g.PolygonOffset(0, 0);
  g.PointSize(1);
  g.PrimitiveRestartIndex(0);
  g.ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  g.SampleMaski(0, ~0U);
  g.SampleCoverage(1, GL_FALSE);
  g.LogicOp(GL_COPY);
  g.BlendColor(0, 0, 0, 0);
  g.ClearColor(0, 0, 0, 0);
  g.ClearDepth(1);
  g.ClearStencil(0);
  g.DepthRange(0, 1);
  for (const GLenum hint : {GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_POLYGON_SMOOTH_HINT})
    g.Hint(hint, GL_DONT_CARE);
  for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES, GL_PACK_IMAGE_HEIGHT,
                            GL_UNPACK_SKIP_IMAGES, GL_UNPACK_IMAGE_HEIGHT, GL_PACK_LSB_FIRST, GL_UNPACK_LSB_FIRST})
    g.PixelStorei(name, 0);
  const int version = testContext().glVersion();
  if (version >= 40) {
    g.Disable(GL_SAMPLE_SHADING);
    g.PatchParameteri(GL_PATCH_VERTICES, 3);
  }
  if (version >= 43) g.Disable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
}

} // namespace tests
