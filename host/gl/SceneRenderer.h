// A small forward renderer: what an engine would have drawn before it calls the effect.
#pragma once

#include "gl/ShadowRenderer.h"
#include "gl/SurfaceRenderer.h"

namespace host {

/// Draws one scene. A pose is worldFromNode for each node, as poseAt() gives it. The render functions set all the GL
/// state that they need, and leave framebuffer 0 bound and the clip control at its default.
class SceneRenderer {
public:
  /// Uploads everything; the scene is not needed afterwards.
  explicit SceneRenderer(const Scene& scene) : buffers_(scene), shadows_(buffers_), surfaces_(buffers_) {}
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  bool hasGlass() const { return buffers_.hasGlass(); }

  /// Draws all that casts shadows into the bound framebuffer, viewport and depth state as they are: no glass and
  /// nothing unlit, masked materials cut out at their cutoff, blended ones where they are not opaque.
  void drawDepthOnly(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld) {
    shadows_.drawDepthOnly(worldFromNode, clipFromWorld);
  }

  /// Draws a light's shadow map, and its glass map if the scene has glass or blended surfaces, through
  /// light.shadow.views in the convention of light.shadow.clipDepth. True depth, without offset; casters before a
  /// directional light's near plane are flattened onto it. A light without views, which nothing can block, gets no
  /// textures. Throws host::Error if size or views break their rules.
  ShadowMapTextures renderShadowMap(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Light& light, int size,
                                    ShadowTarget target = ShadowTarget::Array) {
    return shadows_.render(worldFromNode, light, size, target);
  }

  /// The smoke and strands that there are from now on; none at first. The scene's own are smokeAt() and strandsAt().
  /// Smoke that is not drawn is captured, for something else to draw it.
  void setVolumes(std::vector<SmokeParticle> smoke, Strands strands, bool drawsSmoke = true) {
    volumes_.set(std::move(smoke), std::move(strands), drawsSmoke);
  }

  /// Captures them through light.shadow.views, into maps of `size` texels a side: between begin() and resolve() of an
  /// Avsm whose binding is 0, with a layer for each view. Throws host::Error where the context is older than OpenGL 4.3
  /// or a view has no end.
  void captureVolumes(const tyndall::Light& light, int size) { volumes_.capture(light, size); }

  /// The same of smoke alone, which leaves no depth in the picture: strands do.
  void captureSmoke(const tyndall::Light& light, int size) { volumes_.captureSmoke(light, size); }

  /// Draws the picture: linear radiance and depth. Lights are shadowed where they have a shadow map, and dimmed where
  /// they have curves. The medium, if given, attenuates point and spot lights on their way to the surfaces. Glass,
  /// blended surfaces and smoke leave no depth.
  void renderScene(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
                   const std::vector<tyndall::Light>& lights, RenderTargets& targets, const glm::vec3& skyRadiance,
                   const tyndall::Medium* medium = nullptr) {
    surfaces_.render(worldFromNode, camera, lights, targets, skyRadiance, medium, volumes_);
  }

private:
  SceneBuffers buffers_;
  ShadowRenderer shadows_;
  SurfaceRenderer surfaces_;
  VolumeRenderer volumes_;
};

} // namespace host
