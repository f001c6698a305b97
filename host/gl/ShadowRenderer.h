// Shadow maps and glass maps of lights.
#pragma once

#include "gl/SceneBuffers.h"
#include "scene/Projection.h"

#include <tyndall/tyndall.h>

namespace host {

enum class ShadowTarget {
  Array,  ///< GL_TEXTURE_2D_ARRAY, one layer a view
  Single, ///< GL_TEXTURE_2D, for lights with one view
};

/// The textures of one light, as tyndall::ShadowMap and tyndall::GlassMap describe them.
struct ShadowMapTextures {
  GlTexture depth;       ///< GL_DEPTH_COMPONENT32F
  GlTexture glassColour; ///< GL_RGBA16F; none without glass in the scene
  GlTexture glassDepth;  ///< GL_DEPTH_COMPONENT32F; none without glass in the scene
  ShadowTarget target = ShadowTarget::Array;
  int size = 0; ///< texels per side

  /// Writes the names into light.shadow and light.glass. The textures must outlive their use there.
  void attachTo(tyndall::Light& light) const;
};

class ShadowRenderer {
public:
  explicit ShadowRenderer(const SceneBuffers& buffers); ///< the buffers must outlive it

  /// See SceneRenderer.
  void drawDepthOnly(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld);
  ShadowMapTextures render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Light& light, int size,
                           ShadowTarget target);

private:
  void drawGlass(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld);
  void drawCutOut(Program& program, const SceneBuffers::Draw& draw, const glm::dmat4& clipFromNode, float alphaCutoff);
  void renderGlassLayer(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld, int layer,
                        const ShadowMapTextures& textures, const ClipConvention& convention);

  const SceneBuffers& buffers_;
  Program depth_;
  Program depthAlphaTested_;
  Program glass_;
  GlFramebuffer framebuffer_;
};

} // namespace host
