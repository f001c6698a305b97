// The picture: surfaces in direct and ambient light, sky, glass and blended surfaces.
#pragma once

#include "gl/RenderTargets.h"
#include "gl/SceneBuffers.h"

#include <tyndall/tyndall.h>

namespace host {

class SurfaceRenderer {
public:
  explicit SurfaceRenderer(const SceneBuffers& buffers); ///< the buffers must outlive it

  /// See SceneRenderer::renderScene().
  void render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
              const std::vector<tyndall::Light>& lights, RenderTargets& targets, const glm::vec3& skyRadiance,
              const tyndall::Medium* medium);

private:
  /// What the functions below have in common.
  struct Job {
    const std::vector<glm::dmat4>& worldFromNode;
    const std::vector<tyndall::Light>& lights;
    glm::dmat4 clipFromWorld{1};
    glm::dmat4 viewFromWorld{1};
    glm::dvec3 eye{0}; ///< the camera's position, the origin of relative space
    glm::vec3 extinction{0};
  };

  void drawOpaque(const Job& job);
  void drawTransparent(const Job& job);
  void setAmbient();
  void setLight(const Job& job, const tyndall::Light& light);
  void setShadow(const Job& job, const tyndall::Light& light);
  void draw(const Job& job, const SceneBuffers::Draw& draw);

  const SceneBuffers& buffers_;
  Program surface_;
  Program glass_;
  GlSampler comparison_[2]; ///< of standard and of reversed shadow maps, whatever their textures' own parameters
  GlSampler nearest_;
};

} // namespace host
