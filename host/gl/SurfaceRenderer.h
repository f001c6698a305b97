// The picture: surfaces in direct and ambient light, sky, glass and blended surfaces, strands and smoke.
#pragma once

#include "gl/SceneBuffers.h"
#include "gl/VolumeRenderer.h"

namespace host {

class SurfaceRenderer {
public:
  explicit SurfaceRenderer(const SceneBuffers& buffers); ///< the buffers must outlive it

  /// See SceneRenderer::renderScene().
  void render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
              const std::vector<tyndall::Light>& lights, RenderTargets& targets, const glm::vec3& skyRadiance,
              const tyndall::Medium* medium, VolumeRenderer& volumes);

private:
  /// What the functions below have in common.
  struct Job {
    const std::vector<glm::dmat4>& worldFromNode;
    CameraView camera; ///< its position is the origin of relative space
    Illumination light;
  };

  void drawOpaque(const Job& job);
  void drawTransparent(const Job& job);
  Program& use(const Job& job, const tyndall::AvsmCurves& curves);
  Program& useAmbient(const Job& job);
  Program& useLight(const Job& job, const tyndall::Light& light);
  void draw(const Job& job, const SceneBuffers::Draw& draw, Program& program);

  const SceneBuffers& buffers_;
  LitProgram surface_;
  Program glass_;
  LightUniforms lights_;
};

} // namespace host
