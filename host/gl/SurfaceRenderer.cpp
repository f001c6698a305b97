#include "gl/SurfaceRenderer.h"

#include "gl/ClipConvention.h"
#include "gl/RenderState.h"
#include "gl/Shaders.h"
#include "scene/Error.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace host {

namespace {

enum TextureUnit : GLuint {
  BaseUnit,
  ShadowUnit,
  ShadowArrayUnit,
  ColourUnit,
  ColourArrayUnit,
  PaneUnit,
  PaneArrayUnit
};
constexpr GLuint kUnitCount = 7;

glm::dvec3 toGlm(const tyndall::Vec3& vector) { return {vector[0], vector[1], vector[2]}; }
glm::vec3 toGlm(const tyndall::Rgb& colour) { return {colour[0], colour[1], colour[2]}; }

int passOf(tyndall::LightKind kind) {
  switch (kind) {
  case tyndall::LightKind::Directional:
    return 1;
  case tyndall::LightKind::Point:
    return 2;
  case tyndall::LightKind::Spot:
    return 3;
  }
  return 0;
}

glm::vec3 extinctionOf(const tyndall::Medium* medium) {
  if (!medium) {
    return glm::vec3(0);
  }
  glm::vec3 extinction = toGlm(medium->absorption);
  for (const tyndall::Constituent& constituent : medium->constituents) {
    extinction += toGlm(constituent.scattering);
  }
  return extinction;
}

/// Cofactors transform normals as the inverse transpose does, up to a factor, and exist for singular matrices too.
glm::mat3 normalMatrixOf(const glm::dmat4& worldFromNode) {
  const glm::dvec3 x(worldFromNode[0]);
  const glm::dvec3 y(worldFromNode[1]);
  const glm::dvec3 z(worldFromNode[2]);
  return glm::mat3(glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)));
}

/// World size of a shadow texel at w = 1, which is everywhere for a directional light.
double texelSizeOf(const glm::dmat4& clipFromWorld, int size) {
  const double perUnitX = glm::length(glm::dvec3(glm::row(clipFromWorld, 0)));
  const double perUnitY = glm::length(glm::dvec3(glm::row(clipFromWorld, 1)));
  return 2.0 / (size * std::min(perUnitX, perUnitY));
}

GlSampler makeComparison(GLenum function) {
  GlSampler sampler = makeSampler();
  const GLint parameters[][2] = {{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                 {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                 {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                 {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                 {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                                 {GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(function)}};
  for (const auto& [name, value] : parameters) {
    gl().SamplerParameteri(sampler.name(), static_cast<GLenum>(name), value);
  }
  return sampler;
}

GlSampler makeNearest() {
  GlSampler sampler = makeSampler();
  gl().SamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().SamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return sampler;
}

void bindTexture(GLuint unit, GLenum target, GLuint texture, const GlSampler& sampler) {
  gl().ActiveTexture(GL_TEXTURE0 + unit);
  gl().BindTexture(target, texture);
  gl().BindSampler(unit, sampler.name());
}

int sizeOf(const tyndall::ShadowMap& shadow) {
  const GLenum target = shadow.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  gl().ActiveTexture(GL_TEXTURE0 + (shadow.array ? ShadowArrayUnit : ShadowUnit));
  gl().BindTexture(target, shadow.texture);
  GLint size = 0;
  gl().GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &size);
  return size;
}

} // namespace

SurfaceRenderer::SurfaceRenderer(const SceneBuffers& buffers)
    : buffers_(buffers), surface_("surface", shaders::kSurfaceVertex, shaders::kSurfaceFragment),
      glass_("glass", shaders::kDepthVertex, shaders::kGlassFragment), comparison_{makeComparison(GL_LEQUAL),
                                                                                   makeComparison(GL_GEQUAL)},
      nearest_(makeNearest()) {}

void SurfaceRenderer::render(const std::vector<glm::dmat4>& worldFromNode, const tyndall::Camera& camera,
                             const std::vector<tyndall::Light>& lights, RenderTargets& targets,
                             const glm::vec3& skyRadiance, const tyndall::Medium* medium) {
  buffers_.requirePose(worldFromNode);
  Job job{worldFromNode, lights};
  job.viewFromWorld = fromMat4(camera.viewFromWorld);
  job.clipFromWorld = fromMat4(camera.clipFromView) * job.viewFromWorld;
  const glm::dmat4 worldFromView = glm::inverse(job.viewFromWorld);
  job.eye = glm::dvec3(worldFromView[3]);
  job.extinction = extinctionOf(medium);
  const bool perspective = camera.clipFromView[11] != 0; // row 3, column 2: w depends on z

  resetRenderState();
  const ClipConvention convention = clipConventionOf(camera);
  applyClipConvention(convention);
  gl().BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer());
  gl().Viewport(0, 0, targets.width(), targets.height());
  gl().ClearColor(skyRadiance.r, skyRadiance.g, skyRadiance.b, 1);
  gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

  surface_.use();
  const std::pair<const char*, TextureUnit> samplers[] = {{"baseTexture", BaseUnit},
                                                          {"shadowMap", ShadowUnit},
                                                          {"shadowArray", ShadowArrayUnit},
                                                          {"glassColour", ColourUnit},
                                                          {"glassColourArray", ColourArrayUnit},
                                                          {"glassDepth", PaneUnit},
                                                          {"glassDepthArray", PaneArrayUnit}};
  for (const auto& [name, unit] : samplers) {
    surface_.set(name, static_cast<int>(unit));
  }
  gl().BindSampler(BaseUnit, 0);
  surface_.set("eye", perspective ? glm::vec4(0, 0, 0, 1) : glm::vec4(glm::vec3(worldFromView[2]), 0));
  surface_.set("skyRadiance", skyRadiance);

  gl().DepthFunc(nearerFunction(convention));
  drawOpaque(job);
  gl().DepthFunc(nearerOrEqualFunction(convention));
  drawTransparent(job);

  for (GLuint unit = 0; unit < kUnitCount; ++unit) {
    gl().BindSampler(unit, 0);
  }
  resetRenderState();
  targets.resolve();
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  applyClipConvention({});
}

/// Ambient light and depth first, then each light added where the depth is equal.
void SurfaceRenderer::drawOpaque(const Job& job) {
  const auto drawAll = [&] {
    for (const SceneBuffers::Draw& item : buffers_.draws()) {
      if (item.surface == SurfaceClass::Opaque || item.surface == SurfaceClass::Masked) {
        draw(job, item);
      }
    }
  };
  setAmbient();
  drawAll();
  gl().DepthMask(GL_FALSE);
  gl().DepthFunc(GL_EQUAL);
  gl().Enable(GL_BLEND);
  gl().BlendFunc(GL_ONE, GL_ONE);
  gl().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  for (const tyndall::Light& light : job.lights) {
    setLight(job, light);
    drawAll();
  }
}

/// Farthest first. Glass multiplies what is behind it; a blended surface covers it by alpha, then each light adds.
void SurfaceRenderer::drawTransparent(const Job& job) {
  std::vector<std::pair<double, const SceneBuffers::Draw*>> items;
  for (const SceneBuffers::Draw& item : buffers_.draws()) {
    if (item.surface == SurfaceClass::Blended || item.surface == SurfaceClass::Glass) {
      const glm::dvec3 centre = 0.5 * (item.primitive->low + item.primitive->high);
      const glm::dmat4 viewFromNode = job.viewFromWorld * job.worldFromNode[item.node];
      items.emplace_back((viewFromNode * glm::dvec4(centre, 1)).z, &item);
    }
  }
  std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [viewZ, item] : items) {
    if (item->surface == SurfaceClass::Glass) {
      gl().BlendFunc(GL_ZERO, GL_SRC_COLOR);
      draw(job, *item);
      continue;
    }
    surface_.use();
    setAmbient();
    gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw(job, *item);
    gl().BlendFunc(GL_SRC_ALPHA, GL_ONE);
    for (const tyndall::Light& light : job.lights) {
      setLight(job, light);
      draw(job, *item);
    }
  }
}

void SurfaceRenderer::setAmbient() { surface_.set("pass", 0); }

void SurfaceRenderer::setLight(const Job& job, const tyndall::Light& light) {
  surface_.set("pass", passOf(light.kind));
  surface_.set("lightColour", toGlm(light.colour));
  surface_.set("lightPosition", glm::vec3(toGlm(light.position) - job.eye));
  surface_.set("lightDirection", glm::vec3(glm::normalize(toGlm(light.direction))));
  const double maxRange = std::numeric_limits<float>::max();
  surface_.set("lightRange", static_cast<float>(std::min(light.range, maxRange)));
  surface_.set("extinction", job.extinction);
  // KHR_lights_punctual: falloff = clamp(cos(angle) * scale + offset, 0, 1)^2. The least difference of the cosines is
  // the extension's own.
  const double cosOuter = std::cos(light.outerConeAngle);
  const double scale = 1 / std::max(0.001, std::cos(light.innerConeAngle) - cosOuter);
  surface_.set("spotScaleOffset", glm::vec2(scale, -cosOuter * scale));
  setShadow(job, light);
}

void SurfaceRenderer::setShadow(const Job& job, const tyndall::Light& light) {
  const tyndall::ShadowMap& shadow = light.shadow;
  const std::size_t viewCount = shadow.texture == 0 ? 0 : shadow.views.size();
  if (viewCount > tyndall::kMaxShadowViews) {
    throw Error("light with " + std::to_string(viewCount) + " shadow views: must be at most " +
                std::to_string(tyndall::kMaxShadowViews));
  }
  surface_.set("viewCount", static_cast<int>(viewCount));
  if (viewCount == 0) {
    return;
  }
  const int size = sizeOf(shadow);
  std::vector<glm::mat4> clipFromRelative;
  std::vector<int> layers;
  std::vector<float> texels;
  for (const tyndall::ShadowView& view : shadow.views) {
    const glm::dmat4 clipFromWorld = fromMat4(view.clipFromWorld);
    clipFromRelative.emplace_back(clipFromWorld * glm::translate(glm::dmat4(1), job.eye));
    layers.push_back(view.layer);
    texels.push_back(static_cast<float>(texelSizeOf(clipFromWorld, size)));
  }
  surface_.set("shadowClipFromRelative", clipFromRelative);
  surface_.set("shadowLayer", layers);
  surface_.set("shadowTexel", texels);
  surface_.set("shadowSize", static_cast<float>(size));
  const bool zeroToOne = shadow.clipDepth == tyndall::ClipDepth::ZeroToOne;
  const bool reversed = clipConventionOf(light, shadow.views.front()).reversed;
  surface_.set("depthFromNdc", zeroToOne ? glm::vec2(1, 0) : glm::vec2(0.5F, 0.5F));
  surface_.set("shadowReversed", static_cast<int>(reversed));
  surface_.set("shadowIsArray", static_cast<int>(shadow.array));
  surface_.set("litOutsideViews", static_cast<int>(light.litOutsideViews));
  surface_.set("hasGlass", static_cast<int>(light.glass.colour != 0));
  const GLenum target = shadow.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  bindTexture(shadow.array ? ShadowArrayUnit : ShadowUnit, target, shadow.texture, comparison_[reversed ? 1 : 0]);
  bindTexture(shadow.array ? ColourArrayUnit : ColourUnit, target, light.glass.colour, nearest_);
  bindTexture(shadow.array ? PaneArrayUnit : PaneUnit, target, light.glass.depth, nearest_);
}

void SurfaceRenderer::draw(const Job& job, const SceneBuffers::Draw& draw) {
  const glm::dmat4& worldFromNode = job.worldFromNode[draw.node];
  const glm::dmat4 clipFromNode = job.clipFromWorld * worldFromNode;
  if (SceneBuffers::isBesideView(*draw.primitive, clipFromNode)) {
    return;
  }
  const Material& material = buffers_.material(draw.primitive->material);
  gl().ActiveTexture(GL_TEXTURE0 + BaseUnit);
  gl().BindTexture(GL_TEXTURE_2D, buffers_.textureOf(material));
  Program& program = draw.surface == SurfaceClass::Glass ? glass_ : surface_;
  program.use();
  program.set("clipFromNode", glm::mat4(clipFromNode));
  program.set("relativeFromNode", glm::mat4(glm::translate(glm::dmat4(1), -job.eye) * worldFromNode));
  program.set("relativeFromNodeNormal", normalMatrixOf(worldFromNode));
  program.set("baseTexture", static_cast<int>(BaseUnit));
  program.set("baseColour", material.baseColour);
  program.set("emission", material.emission);
  program.set("transmission", material.transmission);
  program.set("alphaCutoff", material.alphaMode == AlphaMode::Mask ? material.alphaCutoff : 0);
  SceneBuffers::submit(*draw.primitive);
}

} // namespace host
