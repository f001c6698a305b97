// The colour and depth textures that a scene is rendered to.
#pragma once

#include "gl/Objects.h"

namespace host {

struct RenderTargetOptions {
  int width = 0;
  int height = 0;
  GLenum colourFormat = GL_RGBA16F;
  GLenum depthFormat = GL_DEPTH_COMPONENT32F;
  int samples = 1; ///< per pixel; above 1 both textures are multisampled, and colour() is resolved
};

/// Samples of a pixel that the current context can have, in colour and depth.
int mostSamples();

class RenderTargets {
public:
  /// Throws host::Error if the driver cannot give them.
  explicit RenderTargets(const RenderTargetOptions& options);

  int width() const { return options_.width; }
  int height() const { return options_.height; }
  bool multisampled() const { return options_.samples > 1; }
  GLenum depthFormat() const { return options_.depthFormat; }
  float maxRadiance() const; ///< that the colour holds, with room for several lights to add up
  GLuint framebuffer() const { return framebuffer_.name(); } ///< what is drawn to
  GLuint colour() const { return colour_.name(); }           ///< GL_TEXTURE_2D
  GLuint depth() const { return depth_.name(); }             ///< GL_TEXTURE_2D, or _2D_MULTISAMPLE if multisampled()

  /// Averages the samples into colour(); does nothing without multisampling.
  void resolve();

private:
  RenderTargetOptions options_;
  GlTexture colour_;
  GlTexture depth_;
  GlTexture multisampledColour_;
  GlFramebuffer framebuffer_;
  GlFramebuffer resolved_;
};

} // namespace host
