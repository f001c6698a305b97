// What all baselines share: the frame's uniform blocks and maps, programs, render targets, passes and the final blend.
#pragma once

#include <cstdint>
#include <functional>
#include <gl/Gl.h>
#include <gl/Objects.h>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <tyndall/tyndall.h>
#include <vector>

namespace bench {

using Defines = std::vector<std::string>; ///< "NAME value"

/// Texture units. The first four are the engine's maps, as the shaders of glsl/lib name them.
inline constexpr int kSceneDepth = 0, kShadowMap = 1, kGlassColour = 2, kGlassDepth = 3, kOwn = 4;

class Drawer {
public:
  Drawer();

  /// Uploads the frame's block and binds its depth.
  void beginFrame(const tyndall::Frame& frame);
  /// Uploads a light's block and binds its maps.
  void selectLight(const tyndall::Frame& frame, const tyndall::Light& light);
  /// Leaves no texture or sampler of ours bound.
  void endFrame();

  /// The variant of a shader for a light, nullptr: for none.
  Defines definesFor(const tyndall::Frame& frame, const tyndall::Light* light) const;

  /// A program in use, with blocks and map samplers assigned; further samplers by name, from unit kOwn on.
  host::Program& use(const std::string& fragment, const Defines& defines, const std::vector<const char*>& samplers = {},
                     const std::string& vertex = "fullScreen.vert");

  void bind(int unit, GLuint texture, GLenum target = GL_TEXTURE_2D) const;
  void drawFullScreen() const;

  /// A texture of ours by name, made anew when its size or format changes. layers > 0: GL_TEXTURE_3D, linear.
  GLuint target(const std::string& name, GLenum format, int width, int height, int layers = 0);

  /// Renders to these textures, without blending.
  void attach(const std::vector<GLuint>& textures, int width, int height) const;
  /// The same to layers of a 3D texture, and one more 2D texture behind them.
  void attachLayers(GLuint volume, int firstLayer, int layers, GLuint last, int width, int height) const;
  /// Renders to the frame's outputs or into its colour. The first draw also brings the transmittance, the others add.
  void attachFinal(const tyndall::Frame& frame, bool first) const;

  /// Runs a pass and, if asked for, times it by the wall clock around glFinish.
  void pass(const std::string& name, const std::function<void()>& work);
  void timePasses(bool timed) { timed_ = timed; }
  const std::vector<tyndall::PassStatistics>& passes() const { return passes_; }

  GLuint vertexArray() const { return vertexArray_.name(); }
  std::uint64_t bytes() const;
  glm::ivec2 shadowSize() const { return shadowSize_; } ///< of the selected light's map

private:
  struct Target {
    host::GlTexture texture;
    GLenum format = 0;
    int width = 0, height = 0, layers = 0;
  };

  void upload(GLuint binding, const host::GlBuffer& buffer, const std::vector<unsigned char>& data) const;
  void bindMap(int unit, GLuint texture, bool array) const;

  host::GlVertexArray vertexArray_;
  host::GlFramebuffer framebuffer_;
  host::GlSampler nearest_;
  host::GlBuffer frameBlock_;
  host::GlBuffer lightBlock_;
  std::map<std::string, host::Program> programs_;
  std::map<std::string, Target> targets_;
  std::vector<tyndall::PassStatistics> passes_;
  glm::ivec2 shadowSize_{0};
  bool timed_ = false;
};

/// Bytes of a pixel of the formats that baselines use.
int bytesPerPixel(GLenum format);

} // namespace bench
