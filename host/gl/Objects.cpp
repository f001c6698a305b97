#include "gl/Objects.h"

#include "scene/Error.h"

#include <glm/gtc/type_ptr.hpp>

namespace host {

namespace detail {
void destroyBuffer(GLuint name) { gl().DeleteBuffers(1, &name); }
void destroyTexture(GLuint name) { gl().DeleteTextures(1, &name); }
void destroyFramebuffer(GLuint name) { gl().DeleteFramebuffers(1, &name); }
void destroyVertexArray(GLuint name) { gl().DeleteVertexArrays(1, &name); }
void destroySampler(GLuint name) { gl().DeleteSamplers(1, &name); }
void destroyProgram(GLuint name) { gl().DeleteProgram(name); }
} // namespace detail

namespace {

template <class Object>
Object generate(void (*create)(GLsizei, GLuint*)) {
  GLuint name = 0;
  create(1, &name);
  return Object(name);
}

void setPlainSampling(GLenum target) {
  gl().TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl().TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl().TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl().TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
}

/// A pixel format and type that glTexImage accepts for an internal format, for images without data.
std::pair<GLenum, GLenum> transferFormatOf(GLenum internalFormat) {
  switch (internalFormat) {
  case GL_DEPTH_COMPONENT16:
  case GL_DEPTH_COMPONENT24:
  case GL_DEPTH_COMPONENT32:
    return {GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
  case GL_DEPTH_COMPONENT32F:
    return {GL_DEPTH_COMPONENT, GL_FLOAT};
  case GL_R32F:
    return {GL_RED, GL_FLOAT};
  case GL_RGB16F:
  case GL_RGB32F:
  case GL_R11F_G11F_B10F:
    return {GL_RGB, GL_FLOAT};
  case GL_RGBA32UI:
    return {GL_RGBA_INTEGER, GL_UNSIGNED_INT};
  case GL_DEPTH24_STENCIL8:
    return {GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8};
  case GL_DEPTH32F_STENCIL8:
    return {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
  default:
    return {GL_RGBA, GL_FLOAT};
  }
}

void destroyShader(GLuint name) { gl().DeleteShader(name); }
using GlShader = GlObject<destroyShader>;

std::string withDefines(const char* source, const std::vector<std::string>& defines) {
  std::string text = source;
  std::string lines;
  for (const std::string& define : defines) {
    lines += "#define " + define + "\n";
  }
  return text.insert(text.find('\n') + 1, lines);
}

/// GLSL as the context wants it. A text that says itself to be ESSL is left as it is.
std::string inLanguage(const std::string& source) {
  const std::string version = source.substr(0, source.find('\n'));
  if (!isEmbedded() || version.find(" es") != std::string::npos) return source;
  const std::string precisions = "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
  return "#version 320 es\n" + precisions + source.substr(source.find('\n') + 1);
}

GlShader compile(GLenum stage, const std::string& source, const std::string& name) {
  GlShader shader(gl().CreateShader(stage));
  const std::string complete = inLanguage(source);
  const char* text = complete.c_str();
  gl().ShaderSource(shader.name(), 1, &text, nullptr);
  gl().CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl().GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    char log[4096] = {};
    gl().GetShaderInfoLog(shader.name(), sizeof log, nullptr, log);
    throw Error("shader " + name + " does not compile: " + log);
  }
  return shader;
}

} // namespace

GlBuffer makeBuffer() { return generate<GlBuffer>(gl().GenBuffers); }
GlTexture makeTexture() { return generate<GlTexture>(gl().GenTextures); }
GlFramebuffer makeFramebuffer() { return generate<GlFramebuffer>(gl().GenFramebuffers); }
GlVertexArray makeVertexArray() { return generate<GlVertexArray>(gl().GenVertexArrays); }
GlSampler makeSampler() { return generate<GlSampler>(gl().GenSamplers); }

GlTexture makeTexture2D(GLenum internalFormat, int width, int height) {
  GlTexture texture = makeTexture();
  gl().BindTexture(GL_TEXTURE_2D, texture.name());
  const auto [format, type] = transferFormatOf(internalFormat);
  gl().TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internalFormat), width, height, 0, format, type, nullptr);
  setPlainSampling(GL_TEXTURE_2D);
  return texture;
}

GlTexture makeTextureArray(GLenum internalFormat, int width, int height, int layers) {
  GlTexture texture = makeTexture();
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  const auto [format, type] = transferFormatOf(internalFormat);
  gl().TexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(internalFormat), width, height, layers, 0, format, type,
                  nullptr);
  setPlainSampling(GL_TEXTURE_2D_ARRAY);
  return texture;
}

GlTexture makeTexture2DMultisample(GLenum internalFormat, int width, int height, int samples) {
  GlTexture texture = makeTexture();
  gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture.name());
  if (isEmbedded())
    gl().TexStorage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, internalFormat, width, height, GL_TRUE);
  else
    gl().TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, internalFormat, width, height, GL_TRUE);
  return texture;
}

GLenum depthAttachmentOf(GLenum depthFormat) {
  const bool hasStencil = depthFormat == GL_DEPTH24_STENCIL8 || depthFormat == GL_DEPTH32F_STENCIL8;
  return hasStencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

void requireCompleteFramebuffer(const std::string& what) {
  const GLenum status = gl().CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(what + ": the driver cannot make it so large (framebuffer status " + std::to_string(status) + ")");
  }
}

Program::Program(const std::string& name, const char* vertexSource, const char* fragmentSource,
                 const std::vector<std::string>& defines)
    : program_(gl().CreateProgram()) {
  const GlShader vertexShader = compile(GL_VERTEX_SHADER, withDefines(vertexSource, defines), name + " (vertex)");
  const GlShader fragmentShader =
      compile(GL_FRAGMENT_SHADER, withDefines(fragmentSource, defines), name + " (fragment)");
  gl().AttachShader(program_.name(), vertexShader.name());
  gl().AttachShader(program_.name(), fragmentShader.name());
  gl().LinkProgram(program_.name());
  GLint linked = GL_FALSE;
  gl().GetProgramiv(program_.name(), GL_LINK_STATUS, &linked);
  if (!linked) {
    char log[4096] = {};
    gl().GetProgramInfoLog(program_.name(), sizeof log, nullptr, log);
    throw Error("program " + name + " does not link: " + log);
  }
}

GLint Program::location(const char* uniform) {
  const auto found = locations_.find(uniform);
  if (found != locations_.end()) {
    return found->second;
  }
  return locations_[uniform] = gl().GetUniformLocation(program_.name(), uniform);
}

void Program::use() const { gl().UseProgram(program_.name()); }
void Program::set(const char* uniform, int value) { gl().Uniform1i(location(uniform), value); }
void Program::set(const char* uniform, float value) { gl().Uniform1f(location(uniform), value); }
void Program::set(const char* uniform, const glm::vec2& value) { gl().Uniform2f(location(uniform), value.x, value.y); }
void Program::set(const char* uniform, const glm::vec3& value) {
  gl().Uniform3fv(location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::vec4& value) {
  gl().Uniform4fv(location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::mat3& value) {
  gl().UniformMatrix3fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::mat4& value) {
  gl().UniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* uniform, const std::vector<float>& values) {
  gl().Uniform1fv(location(uniform), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set(const char* uniform, const std::vector<int>& values) {
  gl().Uniform1iv(location(uniform), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set(const char* uniform, const std::vector<glm::vec4>& values) {
  if (!values.empty()) {
    gl().Uniform4fv(location(uniform), static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
  }
}
void Program::set(const char* uniform, const std::vector<glm::mat4>& values) {
  if (!values.empty()) {
    gl().UniformMatrix4fv(location(uniform), static_cast<GLsizei>(values.size()), GL_FALSE,
                          glm::value_ptr(values.front()));
  }
}

} // namespace host
