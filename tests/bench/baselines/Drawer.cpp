#include "baselines/Drawer.h"

#include "baselines/ShaderText.h"
#include "baselines/SharedPhysics.h"

#include <algorithm>

#include <chrono>
#include <scene/Error.h>

namespace bench {

namespace {

constexpr float kLargestHalf = 65504;

bool isFloat32(GLuint texture) {
  GLint size = 0;
  host::gl().ActiveTexture(GL_TEXTURE0 + kOwn);
  host::gl().BindTexture(GL_TEXTURE_2D, texture);
  host::gl().GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_RED_SIZE, &size);
  return size == 32;
}

void define(Defines& defines, const char* name, int value) {
  defines.push_back(std::string(name) + " " + std::to_string(value));
}

} // namespace

int bytesPerPixel(GLenum format) {
  switch (format) {
  case GL_R32F:
  case GL_RG16:
    return 4;
  case GL_RGBA16:
  case GL_RGBA16F:
  case GL_RG32F:
    return 8;
  case GL_RGBA32F:
    return 16;
  default:
    throw host::Error("a baseline's texture has a format of unknown size");
  }
}

Drawer::Drawer()
    : vertexArray_(host::makeVertexArray()), framebuffer_(host::makeFramebuffer()), nearest_(host::makeSampler()),
      frameBlock_(host::makeBuffer()), lightBlock_(host::makeBuffer()) {
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    host::gl().SamplerParameteri(nearest_.name(), filter, GL_NEAREST);
  host::gl().SamplerParameteri(nearest_.name(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
}

void Drawer::upload(GLuint binding, const host::GlBuffer& buffer, const Bytes& data) const {
  host::gl().BindBuffer(GL_UNIFORM_BUFFER, buffer.name());
  host::gl().BufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(data.size()), data.data(), GL_STREAM_DRAW);
  host::gl().BindBufferBase(GL_UNIFORM_BUFFER, binding, buffer.name());
}

void Drawer::beginFrame(const tyndall::Frame& frame) {
  passes_.clear();
  const GLuint target = frame.output.inscatter ? frame.output.inscatter : frame.colour;
  upload(0, frameBlock_, frameBlock(frame, isFloat32(target) ? 3e38F : kLargestHalf));
  const GladGLContext& gl = host::gl();
  for (const GLenum state : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND})
    gl.Disable(state);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.BindVertexArray(vertexArray_.name());
  bindMap(kSceneDepth, frame.depth.texture, false);
}

void Drawer::selectLight(const tyndall::Frame& frame, const tyndall::Light& light) {
  shadowSize_ = {0, 0};
  if (light.shadow.texture) {
    const GLenum target = light.shadow.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    bindMap(kShadowMap, light.shadow.texture, light.shadow.array);
    host::gl().GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &shadowSize_.x);
    host::gl().GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &shadowSize_.y);
  }
  if (light.glass.colour) {
    bindMap(kGlassColour, light.glass.colour, light.shadow.array);
    bindMap(kGlassDepth, light.glass.depth, light.shadow.array);
  }
  upload(1, lightBlock_, lightBlock(frame, light, shadowSize_.x, shadowSize_.y));
}

void Drawer::endFrame() {
  const GladGLContext& gl = host::gl();
  for (GLuint unit = 0; unit < kOwn; ++unit)
    gl.BindSampler(unit, 0);
  gl.Disable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ZERO); // Mesa refuses two targets while a function names a second source, even if disabled
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0); // so that no deleted program stays current
  gl.ActiveTexture(GL_TEXTURE0);
}

Defines Drawer::definesFor(const tyndall::Frame& frame, const tyndall::Light* light) const {
  Defines defines;
  define(defines, "MONOCHROME", isMonochrome(frame.medium) ? 1 : 0);
  define(defines, "COMPOSITE", frame.output.inscatter ? 0 : 1);
  if (!light) return defines;
  define(defines, "LIGHT_KIND", static_cast<int>(light->kind));
  define(defines, "BOUNDARY", light->boundary.enabled ? 1 : 0);
  const std::size_t views = light->shadow.texture ? light->shadow.views.size() : 0;
  define(defines, "SHADOW_VIEWS", views > 1 ? 2 : static_cast<int>(views));
  define(defines, "SHADOW_ARRAY", light->shadow.array ? 1 : 0);
  define(defines, "FILTER_BILINEAR", 0);
  define(defines, "GLASS", light->glass.colour ? 1 : 0);
  return defines;
}

host::Program& Drawer::use(const std::string& fragment, const Defines& defines,
                           const std::vector<const char*>& samplers, const std::string& vertex) {
  std::string key = fragment + " " + vertex;
  for (const std::string& line : defines)
    key += " " + line;
  const auto found = programs_.find(key);
  if (found != programs_.end()) {
    found->second.use();
    return found->second;
  }
  host::Program& program =
      programs_.emplace(key, host::Program(fragment, shaderText(vertex).c_str(), shaderText(fragment).c_str(), defines))
          .first->second;
  program.use();
  GLint current = 0;
  host::gl().GetIntegerv(GL_CURRENT_PROGRAM, &current);
  const auto name = static_cast<GLuint>(current);
  GLuint binding = 0;
  for (const char* block : {"FrameBlock", "LightBlock"}) {
    const GLuint index = host::gl().GetUniformBlockIndex(name, block);
    if (index != GL_INVALID_INDEX) host::gl().UniformBlockBinding(name, index, binding);
    ++binding;
  }
  int unit = kSceneDepth;
  for (const char* sampler : {"sceneDepth", "shadowMap", "glassColour", "glassDepth"})
    program.set(sampler, unit++);
  for (const char* sampler : samplers)
    program.set(sampler, unit++);
  return program;
}

void Drawer::bindMap(int unit, GLuint texture, bool array) const {
  bind(unit, texture, array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D);
  host::gl().BindSampler(static_cast<GLuint>(unit), nearest_.name());
}

void Drawer::bind(int unit, GLuint texture, GLenum target) const {
  host::gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  host::gl().BindTexture(target, texture);
}

void Drawer::drawFullScreen() const { host::gl().DrawArrays(GL_TRIANGLES, 0, 3); }

GLuint Drawer::target(const std::string& name, GLenum format, int width, int height, int layers) {
  Target& target = targets_[name];
  if (target.texture && target.format == format && target.width == width && target.height == height &&
      target.layers == layers)
    return target.texture.name();
  host::gl().ActiveTexture(GL_TEXTURE0 + kOwn);
  target = {{}, format, width, height, layers};
  if (layers == 0) {
    target.texture = host::makeTexture2D(format, width, height);
    return target.texture.name();
  }
  const GladGLContext& gl = host::gl();
  target.texture = host::makeTexture();
  gl.BindTexture(GL_TEXTURE_3D, target.texture.name());
  gl.TexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(format), width, height, layers, 0, GL_RGBA, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl.TexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
  return target.texture.name();
}

namespace {

void setDrawBuffers(int used) {
  std::vector<GLenum> buffers;
  for (int i = 0; i < used; ++i)
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
  host::gl().DrawBuffers(used, buffers.data());
}

constexpr int kAttachments = 8;

void detachFrom(int first) {
  for (int i = first; i < kAttachments; ++i)
    host::gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i), GL_TEXTURE_2D, 0, 0);
}

} // namespace

void Drawer::attach(const std::vector<GLuint>& textures, int width, int height) const {
  const GladGLContext& gl = host::gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  int count = 0;
  for (const GLuint texture : textures)
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(count++), GL_TEXTURE_2D, texture,
                            0);
  detachFrom(count);
  setDrawBuffers(count);
  gl.Disable(GL_BLEND);
  gl.Viewport(0, 0, width, height);
}

void Drawer::attachLayers(GLuint volume, int firstLayer, int layers, GLuint last, int width, int height) const {
  const GladGLContext& gl = host::gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  for (int i = 0; i < layers; ++i)
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i), volume, 0,
                               firstLayer + i);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(layers), GL_TEXTURE_2D, last, 0);
  detachFrom(layers + 1);
  setDrawBuffers(layers + 1);
  gl.Disable(GL_BLEND);
  gl.Viewport(0, 0, width, height);
}

void Drawer::attachFinal(const tyndall::Frame& frame, bool first) const {
  const GladGLContext& gl = host::gl();
  if (!frame.output.inscatter) {
    attach({frame.colour}, frame.viewport.width, frame.viewport.height);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, first ? GL_SRC1_COLOR : GL_ONE);
    return;
  }
  std::vector<GLuint> outputs = {frame.output.inscatter};
  if (first && frame.output.transmittance) outputs.push_back(frame.output.transmittance);
  attach(outputs, frame.viewport.width, frame.viewport.height);
  if (first) return;
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE);
}

void Drawer::pass(const std::string& name, const std::function<void()>& work) {
  tyndall::PassStatistics statistics;
  statistics.name = name;
  if (timed_) host::gl().Finish();
  const auto start = std::chrono::steady_clock::now();
  work();
  if (timed_) {
    host::gl().Finish();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    statistics.milliseconds = time.count();
  }
  passes_.push_back(statistics);
}

std::uint64_t Drawer::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& [name, target] : targets_)
    sum += static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height) *
           static_cast<std::uint64_t>(std::max(target.layers, 1)) *
           static_cast<std::uint64_t>(bytesPerPixel(target.format));
  return sum;
}

} // namespace bench
