// Move-only names of GL objects, and programs. All of it needs a current context, the destructors too.
#pragma once

#include "gl/Gl.h"

#include <glm/glm.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace host {

/// Owns one GL name; 0 owns nothing.
template <void (*destroy)(GLuint)>
class GlObject {
public:
  GlObject() = default;
  explicit GlObject(GLuint name) : name_(name) {}
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset() {
    if (name_ != 0) {
      destroy(std::exchange(name_, 0));
    }
  }

private:
  GLuint name_ = 0;
};

namespace detail {
void destroyBuffer(GLuint name);
void destroyTexture(GLuint name);
void destroyFramebuffer(GLuint name);
void destroyVertexArray(GLuint name);
void destroySampler(GLuint name);
void destroyProgram(GLuint name);
} // namespace detail

using GlBuffer = GlObject<detail::destroyBuffer>;
using GlTexture = GlObject<detail::destroyTexture>;
using GlFramebuffer = GlObject<detail::destroyFramebuffer>;
using GlVertexArray = GlObject<detail::destroyVertexArray>;
using GlSampler = GlObject<detail::destroySampler>;

GlBuffer makeBuffer();
GlTexture makeTexture();
GlFramebuffer makeFramebuffer();
GlVertexArray makeVertexArray();
GlSampler makeSampler();

/// An empty texture without mipmaps, nearest filter, clamped to its edge. Left bound to its target on the active unit.
GlTexture makeTexture2D(GLenum internalFormat, int width, int height);
GlTexture makeTextureArray(GLenum internalFormat, int width, int height, int layers);
GlTexture makeTexture2DMultisample(GLenum internalFormat, int width, int height, int samples);

/// The attachment point of a depth format: GL_DEPTH_STENCIL_ATTACHMENT for those with stencil.
GLenum depthAttachmentOf(GLenum depthFormat);

/// Throws host::Error if the framebuffer bound to GL_FRAMEBUFFER is not complete; `what` names it.
void requireCompleteFramebuffer(const std::string& what);

/// A linked program. set() needs it in use; a uniform that the program lacks is ignored, as GL does.
class Program {
public:
  /// Lines "#define X" go behind the #version line; desktop GLSL is turned into ESSL where the context wants that.
  /// Throws host::Error with the log.
  Program(const std::string& name, const char* vertexSource, const char* fragmentSource,
          const std::vector<std::string>& defines = {});

  void use() const;
  void set(const char* uniform, int value);
  void set(const char* uniform, float value);
  void set(const char* uniform, const glm::vec2& value);
  void set(const char* uniform, const glm::vec3& value);
  void set(const char* uniform, const glm::vec4& value);
  void set(const char* uniform, const glm::mat3& value);
  void set(const char* uniform, const glm::mat4& value);
  void set(const char* uniform, const std::vector<float>& values);
  void set(const char* uniform, const std::vector<int>& values);
  void set(const char* uniform, const std::vector<glm::vec4>& values);
  void set(const char* uniform, const std::vector<glm::mat4>& values);

private:
  GLint location(const char* uniform);

  GlObject<detail::destroyProgram> program_;
  std::unordered_map<std::string, GLint> locations_;
};

} // namespace host
