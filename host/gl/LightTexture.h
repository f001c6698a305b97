// Light at many points at once, as a texture: what is blended in order, smoke and strands, is lit before it is drawn.
#pragma once

#include "gl/LitProgram.h"

#include <functional>

namespace host {

/// The lights of a picture.
struct Illumination {
  const std::vector<tyndall::Light>& lights;
  glm::vec3 skyRadiance{0};
  const tyndall::Medium* medium = nullptr; ///< null: none
  float maxRadiance = 0;                   ///< that the picture holds: what is brighter is cut
};

class LightTexture {
public:
  /// Each texel is a point that the fragment shader places; it goes behind shaders::kLights, and what it writes for the
  /// sky and for each light is added up. `filter`: GL_NEAREST or GL_LINEAR.
  LightTexture(const char* name, const char* fragmentBody, GLenum filter);

  /// Positions are relative to `origin`. setUniforms: what the shader needs besides the lights; textures from
  /// kFirstFreeUnit on. Leaves another framebuffer and viewport, and blending on.
  void render(const glm::ivec2& size, const Illumination& illumination, const glm::dvec3& origin,
              const std::function<void(Program&)>& setUniforms);

  GLuint texture() const { return texture_.name(); } ///< GL_TEXTURE_2D, RGBA32F

private:
  LitProgram program_;
  LightUniforms lights_;
  GlTexture texture_;
  GlFramebuffer framebuffer_;
  GlVertexArray empty_;
  GLenum filter_;
  glm::ivec2 size_{0};
};

} // namespace host
