#include "gl/SurfaceRenderer.h"

#include "gl/RenderState.h"
#include "gl/Shaders.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace host {

namespace {

/// Cofactors transform normals as the inverse transpose does, up to a factor, and exist for singular matrices too.
glm::mat3 normalMatrixOf(const glm::dmat4& worldFromNode) {
  const glm::dvec3 x(worldFromNode[0]);
  const glm::dvec3 y(worldFromNode[1]);
  const glm::dvec3 z(worldFromNode[2]);
  return glm::mat3(glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)));
}

} // namespace

SurfaceRenderer::SurfaceRenderer(const SceneBuffers& buffers)
    : buffers_(buffers), surface_("surface", shaders::kSurfaceVertex, shaders::kSurfaceFragment),
      glass_("glass", shaders::kDepthVertex, shaders::kGlassFragment) {}

void SurfaceRenderer::render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
                             const std::vector<tyndall::Light>& lights, RenderTargets& targets,
                             const glm::vec3& skyRadiance, const tyndall::Medium* medium, VolumeRenderer& volumes) {
  buffers_.requirePose(worldFromNode);
  const Job job{worldFromNode, CameraView(camera), {lights, skyRadiance, medium, targets.maxRadiance()}};
  resetRenderState();
  applyClipConvention(job.camera.convention);
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().Viewport(0, 0, targets.width(), targets.height());
  gl().ClearColor(skyRadiance.r, skyRadiance.g, skyRadiance.b, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

  gl().BindSampler(LightUniforms::kBaseUnit, 0);
  gl().DepthFunc(nearerFunction(job.camera.convention));
  drawOpaque(job);
  volumes.drawStrands(job.camera, job.light, targets);
  gl().DepthFunc(nearerOrEqualFunction(job.camera.convention));
  drawTransparent(job);
  volumes.drawSmoke(job.camera, job.light, targets);

  LightUniforms::unbindSamplers();
  resetRenderState();
  targets.resolve();
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  applyClipConvention({});
}

/// Ambient light and depth first, then each light added where the depth is equal.
void SurfaceRenderer::drawOpaque(const Job& job) {
  const auto drawAll = [&](Program& program) {
    for (const SceneBuffers::Draw& item : buffers_.draws()) {
      if (item.surface == SurfaceClass::Opaque || item.surface == SurfaceClass::Masked) {
        draw(job, item, program);
      }
    }
  };
  drawAll(useAmbient(job));
  gl().DepthMask(GL_FALSE);
  gl().DepthFunc(GL_EQUAL);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  for (const tyndall::Light& light : job.light.lights) {
    drawAll(useLight(job, light));
  }
}

/// Farthest first. Glass multiplies what is behind it; a blended surface covers it by alpha, then each light adds.
void SurfaceRenderer::drawTransparent(const Job& job) {
  std::vector<std::pair<double, const SceneBuffers::Draw*>> items;
  for (const SceneBuffers::Draw& item : buffers_.draws()) {
    if (item.surface == SurfaceClass::Blended || item.surface == SurfaceClass::Glass) {
      const glm::dvec3 centre = 0.5 * (item.primitive->low + item.primitive->high);
      const glm::dmat4 viewFromNode = job.camera.viewFromWorld * job.worldFromNode[item.node];
      items.emplace_back((viewFromNode * glm::dvec4(centre, 1)).z, &item);
    }
  }
  std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [viewZ, item] : items) {
    if (item->surface == SurfaceClass::Glass) {
      gl().BlendFunc(GL_ZERO, GL_SRC_COLOR);
      glass_.use();
      draw(job, *item, glass_);
      continue;
    }
    gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw(job, *item, useAmbient(job));
    gl().BlendFunc(GL_SRC_ALPHA, GL_ONE);
    for (const tyndall::Light& light : job.light.lights) {
      draw(job, *item, useLight(job, light));
    }
  }
}

Program& SurfaceRenderer::use(const Job& job, const tyndall::AvsmCurves& curves) {
  Program& program = surface_.variantFor(curves);
  program.use();
  program.set("maxRadiance", job.light.maxRadiance);
  program.set("eye", job.camera.viewerFrom(job.camera.eye));
  return program;
}

Program& SurfaceRenderer::useAmbient(const Job& job) {
  Program& program = use(job, {});
  LightUniforms::setAmbient(program, job.light.skyRadiance);
  return program;
}

Program& SurfaceRenderer::useLight(const Job& job, const tyndall::Light& light) {
  Program& program = use(job, light.curves);
  lights_.set(program, light, job.camera.eye, job.light.medium);
  return program;
}

void SurfaceRenderer::draw(const Job& job, const SceneBuffers::Draw& draw, Program& program) {
  const glm::dmat4& worldFromNode = job.worldFromNode[draw.node];
  const glm::dmat4 clipFromNode = job.camera.clipFromWorld * worldFromNode;
  if (SceneBuffers::isBesideView(*draw.primitive, clipFromNode)) {
    return;
  }
  const Material& material = buffers_.material(draw.primitive->material);
  gl().ActiveTexture(GL_TEXTURE0 + LightUniforms::kBaseUnit);
  gl().BindTexture(GL_TEXTURE_2D, buffers_.textureOf(material));
  program.set("clipFromNode", glm::mat4(clipFromNode));
  program.set("relativeFromNode", glm::mat4(glm::translate(glm::dmat4(1), -job.camera.eye) * worldFromNode));
  program.set("relativeFromNodeNormal", normalMatrixOf(worldFromNode));
  program.set("baseTexture", static_cast<int>(LightUniforms::kBaseUnit));
  program.set("baseColour", material.baseColour);
  program.set("emission", material.emission);
  program.set("transmission", material.transmission);
  program.set("coveredByAlpha", static_cast<int>(material.alphaMode == AlphaMode::Blend));
  program.set("opaqueAlpha", 2.0F); // none is left out
  program.set("unlit", static_cast<int>(material.unlit));
  program.set("alphaCutoff", material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0);
  SceneBuffers::submit(*draw.primitive);
}

} // namespace host
