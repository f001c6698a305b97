#include "gl/ShadowRenderer.h"

#include "gl/ClipConvention.h"
#include "gl/RenderState.h"
#include "gl/Shaders.h"
#include "scene/Error.h"

#include <algorithm>

namespace host {

namespace {

/// A blended surface casts a shadow from this alpha on, half a step below 1 in 8 bits, and tints light below it.
constexpr float kOpaqueAlpha = 1 - 0.5F / 255;

void attach(GLenum attachment, const GlTexture& texture, ShadowTarget target, int layer) {
  if (target == ShadowTarget::Array) {
    gl().FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture.name(), 0, layer);
  } else {
    gl().FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
  }
}

GlTexture makeMap(GLenum format, int size, ShadowTarget target, int layers) {
  return target == ShadowTarget::Array ? makeTextureArray(format, size, size, layers)
                                       : makeTexture2D(format, size, size);
}

int layersOf(const tyndall::ShadowMap& shadow) {
  int layers = 0;
  for (const tyndall::ShadowView& view : shadow.views) {
    layers = std::max(layers, view.layer + 1);
  }
  return layers;
}

void check(const tyndall::ShadowMap& shadow, int size, ShadowTarget target) {
  GLint maxSize = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSize);
  maxSize = std::min(maxSize, tyndall::kMaxImageSize);
  if (size < 1 || size > maxSize) {
    throw Error("shadow map size " + std::to_string(size) + ": must be 1 to " + std::to_string(maxSize));
  }
  if (shadow.views.size() > tyndall::kMaxShadowViews) {
    throw Error("shadow map of " + std::to_string(shadow.views.size()) + " views: must be at most " +
                std::to_string(tyndall::kMaxShadowViews));
  }
  for (const tyndall::ShadowView& view : shadow.views) {
    const int maxLayer = target == ShadowTarget::Single ? 0 : tyndall::kMaxShadowViews - 1;
    if (view.layer < 0 || view.layer > maxLayer) {
      throw Error("shadow view layer " + std::to_string(view.layer) + ": must be 0 to " + std::to_string(maxLayer));
    }
  }
}

} // namespace

void ShadowMapTextures::attachTo(tyndall::Light& light) const {
  light.shadow.texture = depth.name();
  light.shadow.array = target == ShadowTarget::Array;
  light.glass.colour = glassColour.name();
  light.glass.depth = glassDepth.name();
}

ShadowRenderer::ShadowRenderer(const SceneBuffers& buffers)
    : buffers_(buffers), depth_("depth", shaders::kDepthVertex, shaders::kDepthFragment),
      depthAlphaTested_("depth", shaders::kDepthVertex, shaders::kDepthFragment, {"ALPHA_TESTED"}),
      glass_("glass", shaders::kDepthVertex, shaders::kGlassFragment), framebuffer_(makeFramebuffer()) {}

void ShadowRenderer::drawDepthOnly(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld) {
  buffers_.requirePose(worldFromNode);
  for (const SceneBuffers::Draw& draw : buffers_.draws()) {
    const glm::dmat4 clipFromNode = clipFromWorld * worldFromNode[draw.node];
    if (!draw.casts || draw.surface == SurfaceClass::Glass ||
        SceneBuffers::isBesideView(*draw.primitive, clipFromNode)) {
      continue;
    }
    if (draw.surface == SurfaceClass::Opaque) {
      depth_.use();
      depth_.set("clipFromNode", glm::mat4(clipFromNode));
      SceneBuffers::submit(*draw.primitive);
    } else {
      const bool masked = draw.surface == SurfaceClass::Masked;
      const float cutoff = masked ? buffers_.material(draw.primitive->material).alphaCutoff : kOpaqueAlpha;
      drawCutOut(depthAlphaTested_, draw, clipFromNode, cutoff);
    }
  }
}

void ShadowRenderer::drawCutOut(Program& program, const SceneBuffers::Draw& draw, const glm::dmat4& clipFromNode,
                                float alphaCutoff) {
  const Material& material = buffers_.material(draw.primitive->material);
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindTexture(GL_TEXTURE_2D, buffers_.textureOf(material));
  gl().BindSampler(0, 0);
  program.use();
  program.set("baseTexture", 0);
  program.set("baseColour", material.baseColour);
  program.set("alphaCutoff", alphaCutoff);
  program.set("transmission", material.transmission);
  program.set("coveredByAlpha", static_cast<int>(material.alphaMode == AlphaMode::Blend));
  program.set("opaqueAlpha", draw.surface == SurfaceClass::Blended ? kOpaqueAlpha : 2);
  program.set("clipFromNode", glm::mat4(clipFromNode));
  SceneBuffers::submit(*draw.primitive);
}

void ShadowRenderer::drawGlass(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld) {
  for (const SceneBuffers::Draw& draw : buffers_.draws()) {
    const glm::dmat4 clipFromNode = clipFromWorld * worldFromNode[draw.node];
    if (!draw.tintsLight() || SceneBuffers::isBesideView(*draw.primitive, clipFromNode)) {
      continue;
    }
    const Material& material = buffers_.material(draw.primitive->material);
    drawCutOut(glass_, draw, clipFromNode, material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0);
  }
}

/// The colour: the product of the panes that no opaque caster hides. The depth: the nearest pane's.
void ShadowRenderer::renderGlassLayer(const std::vector<glm::dmat4>& worldFromNode, const glm::dmat4& clipFromWorld,
                                      int layer, const ShadowMapTextures& textures, const ClipConvention& convention) {
  attach(GL_COLOR_ATTACHMENT0, textures.glassColour, textures.target, layer);
  attach(GL_DEPTH_ATTACHMENT, textures.depth, textures.target, layer);
  gl().DrawBuffer(GL_COLOR_ATTACHMENT0);
  requireCompleteFramebuffer("glass map");
  gl().ClearColor(1, 1, 1, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ZERO, GL_SRC_COLOR);
  gl().DepthMask(GL_FALSE);
  gl().DepthFunc(nearerOrEqualFunction(convention));
  drawGlass(worldFromNode, clipFromWorld);

  gl().Disable(GL_BLEND);
  gl().DepthMask(GL_TRUE);
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  attach(GL_DEPTH_ATTACHMENT, textures.glassDepth, textures.target, layer);
  gl().DrawBuffer(GL_NONE);
  gl().Clear(GL_DEPTH_BUFFER_BIT);
  gl().DepthFunc(nearerFunction(convention));
  drawGlass(worldFromNode, clipFromWorld);
}

ShadowMapTextures ShadowRenderer::render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Light& light,
                                         int size, ShadowTarget target) {
  check(light.shadow, size, target);
  const int layers = layersOf(light.shadow);
  ShadowMapTextures textures;
  textures.target = target;
  textures.size = size;
  if (light.shadow.views.empty()) {
    return textures;
  }
  textures.depth = makeMap(GL_DEPTH_COMPONENT32F, size, target, layers);
  if (buffers_.hasGlass()) {
    textures.glassColour = makeMap(GL_RGBA16F, size, target, layers);
    textures.glassDepth = makeMap(GL_DEPTH_COMPONENT32F, size, target, layers);
  }
  resetRenderState();
  if (light.kind == tyndall::LightKind::Directional) {
    gl().Enable(GL_DEPTH_CLAMP);
  }
  gl().Viewport(0, 0, size, size);
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  for (const tyndall::ShadowView& view : light.shadow.views) {
    const glm::dmat4 clipFromWorld = fromMat4(view.clipFromWorld);
    const ClipConvention convention = clipConventionOf(light, view);
    applyClipConvention(convention);
    attach(GL_DEPTH_ATTACHMENT, textures.depth, target, view.layer);
    gl().DrawBuffer(GL_NONE);
    gl().ReadBuffer(GL_NONE);
    requireCompleteFramebuffer("shadow map");
    gl().DepthFunc(nearerFunction(convention));
    gl().Clear(GL_DEPTH_BUFFER_BIT);
    drawDepthOnly(worldFromNode, clipFromWorld);
    if (buffers_.hasGlass()) {
      renderGlassLayer(worldFromNode, clipFromWorld, view.layer, textures, convention);
    }
  }
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl().Disable(GL_DEPTH_CLAMP);
  applyClipConvention({});
  return textures;
}

} // namespace host
