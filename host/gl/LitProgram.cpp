#include "gl/LitProgram.h"

#include "gl/ClipConvention.h"
#include "gl/LightShader.h"
#include "scene/Error.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <tyndall/avsm.h>

namespace host {

namespace {

enum TextureUnit : GLuint {
  ShadowUnit = LightUniforms::kBaseUnit + 1,
  ShadowArrayUnit,
  ColourUnit,
  ColourArrayUnit,
  PaneUnit,
  PaneArrayUnit,
  CurvesUnit
};
static_assert(CurvesUnit + 1 == kFirstFreeUnit);

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

void setSamplers(Program& program) {
  const std::pair<const char*, TextureUnit> samplers[] = {
      {"shadowMap", ShadowUnit},   {"shadowArray", ShadowArrayUnit},
      {"glassColour", ColourUnit}, {"glassColourArray", ColourArrayUnit},
      {"glassDepth", PaneUnit},    {"glassDepthArray", PaneArrayUnit},
      {"curves", CurvesUnit}};
  for (const auto& [name, unit] : samplers) {
    program.set(name, static_cast<int>(unit));
  }
}

} // namespace

double texelSizeOf(const glm::dmat4& clipFromWorld, int size) {
  const double perUnitX = glm::length(glm::dvec3(glm::row(clipFromWorld, 0)));
  const double perUnitY = glm::length(glm::dvec3(glm::row(clipFromWorld, 1)));
  return 2.0 / (size * std::min(perUnitX, perUnitY));
}

LitProgram::LitProgram(std::string name, const char* vertexSource, const char* fragmentBody)
    : name_(std::move(name)), vertexSource_(vertexSource), fragmentBody_(fragmentBody) {}

Program& LitProgram::variantFor(const tyndall::AvsmCurves& curves) {
  const int key = curves.texture == 0 ? 0 : 2 * curves.nodes + (curves.packed ? 1 : 0);
  const auto found = variants_.find(key);
  if (found != variants_.end()) {
    return found->second;
  }
  std::string source = "#version 330 core\n";
  if (key != 0) {
    source += "#define TYNDALL_CURVE_NODES " + std::to_string(curves.nodes) + "\n#define TYNDALL_CURVE_PACKED " +
              (curves.packed ? "1\n" : "0\n") + tyndall::avsmLookupSource();
  }
  source += std::string(shaders::kLights) + fragmentBody_;
  return variants_.emplace(key, Program(name_, vertexSource_, source.c_str())).first->second;
}

LightUniforms::LightUniforms()
    : comparison_{makeComparison(GL_LEQUAL), makeComparison(GL_GEQUAL)}, nearest_(makeNearest()) {}

void LightUniforms::setAmbient(Program& program, const glm::vec3& skyRadiance) {
  setSamplers(program);
  program.set("pass", 0);
  program.set("skyRadiance", skyRadiance);
}

void LightUniforms::unbindSamplers() {
  for (GLuint unit = 0; unit < kFirstFreeUnit; ++unit) {
    gl().BindSampler(unit, 0);
  }
}

void LightUniforms::set(Program& program, const tyndall::Light& light, const glm::dvec3& origin,
                        const tyndall::Medium* medium) const {
  setSamplers(program);
  program.set("pass", passOf(light.kind));
  program.set("lightColour", toGlm(light.colour));
  program.set("lightPosition", glm::vec3(toGlm(light.position) - origin));
  program.set("lightDirection", glm::vec3(glm::normalize(toGlm(light.direction))));
  const double maxRange = std::numeric_limits<float>::max();
  program.set("lightRange", static_cast<float>(std::min(light.range, maxRange)));
  setMedium(program, medium ? *medium : tyndall::Medium(), origin);
  // KHR_lights_punctual: falloff = clamp(cos(angle) * scale + offset, 0, 1)^2. The least difference of the cosines is
  // the extension's own.
  const double cosOuter = std::cos(light.outerConeAngle);
  const double scale = 1 / std::max(0.001, std::cos(light.innerConeAngle) - cosOuter);
  program.set("spotScaleOffset", glm::vec2(scale, -cosOuter * scale));
  setShadow(program, light, origin);
}

void LightUniforms::setMedium(Program& program, const tyndall::Medium& medium, const glm::dvec3& origin) {
  constexpr std::size_t kLayers = tyndall::kMaxHeightLayers;
  std::vector<glm::dvec3> extinction(1 + kLayers, glm::dvec3(0)); // of what is the same everywhere, and of each layer
  const auto add = [&](int layer, const tyndall::Rgb& coefficient) {
    const auto place = static_cast<std::size_t>(layer + 1); // one that is none is the effect's to refuse
    if (place < extinction.size()) extinction[place] += glm::dvec3(toGlm(coefficient));
  };
  add(medium.absorptionLayer, medium.absorption);
  for (const tyndall::Constituent& constituent : medium.constituents) {
    add(constituent.layer, constituent.scattering);
  }
  std::vector<glm::vec4> ups(kLayers, glm::vec4(0)), extinctions(kLayers, glm::vec4(0));
  for (std::size_t i = 0; i < medium.layers.size(); ++i) {
    const tyndall::HeightLayer& layer = medium.layers[i];
    const bool isEven = !std::isfinite(layer.scale);
    const glm::dvec3 up = glm::normalize(toGlm(medium.up)) / layer.scale;
    constexpr double kDensest = -60;
    const double ground = isEven ? kDensest : std::max((layer.ground - layer.height) / layer.scale, kDensest);
    ups[i] = glm::vec4(glm::dvec4(up, isEven ? 0 : glm::dot(up, origin) - layer.height / layer.scale));
    extinctions[i] = glm::vec4(glm::dvec4(extinction[i + 1], ground));
  }
  program.set("extinction", glm::vec3(extinction[0]));
  program.set("layerUp", ups);
  program.set("layerExtinction", extinctions);
}

void LightUniforms::setShadow(Program& program, const tyndall::Light& light, const glm::dvec3& origin) const {
  const tyndall::ShadowMap& shadow = light.shadow;
  const std::size_t viewCount = shadow.texture == 0 ? 0 : shadow.views.size();
  if (viewCount > tyndall::kMaxShadowViews) {
    throw Error("light with " + std::to_string(viewCount) + " shadow views: must be at most " +
                std::to_string(tyndall::kMaxShadowViews));
  }
  program.set("viewCount", static_cast<int>(viewCount));
  if (viewCount == 0) {
    return;
  }
  const int size = sizeOf(shadow);
  std::vector<glm::mat4> clipFromRelative;
  std::vector<int> layers;
  std::vector<float> texels;
  for (const tyndall::ShadowView& view : shadow.views) {
    const glm::dmat4 clipFromWorld = fromMat4(view.clipFromWorld);
    clipFromRelative.emplace_back(clipFromWorld * glm::translate(glm::dmat4(1), origin));
    layers.push_back(view.layer);
    texels.push_back(static_cast<float>(texelSizeOf(clipFromWorld, size)));
  }
  program.set("shadowClipFromRelative", clipFromRelative);
  program.set("shadowLayer", layers);
  program.set("shadowTexel", texels);
  program.set("shadowSize", static_cast<float>(size));
  const bool zeroToOne = shadow.clipDepth == tyndall::ClipDepth::ZeroToOne;
  const bool reversed = clipConventionOf(light, shadow.views.front()).reversed;
  program.set("depthFromNdc", zeroToOne ? glm::vec2(1, 0) : glm::vec2(0.5F, 0.5F));
  program.set("shadowReversed", static_cast<int>(reversed));
  program.set("shadowIsArray", static_cast<int>(shadow.array));
  program.set("litOutsideViews", static_cast<int>(light.litOutsideViews));
  program.set("hasGlass", static_cast<int>(light.glass.colour != 0));
  const GLenum target = shadow.array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  bindTexture(shadow.array ? ShadowArrayUnit : ShadowUnit, target, shadow.texture, comparison_[reversed ? 1 : 0]);
  bindTexture(shadow.array ? ColourArrayUnit : ColourUnit, target, light.glass.colour, nearest_);
  bindTexture(shadow.array ? PaneArrayUnit : PaneUnit, target, light.glass.depth, nearest_);
  if (light.curves.texture != 0) {
    setCurves(program, light, origin);
  }
}

void LightUniforms::setCurves(Program& program, const tyndall::Light& light, const glm::dvec3& origin) const {
  std::vector<glm::vec4> depths;
  for (int view = 0; view < static_cast<int>(light.shadow.views.size()); ++view) {
    std::array<double, 4> d{};
    const tyndall::Status status = tyndall::avsmDepth(light, view, d);
    if (!status) {
      throw Error("curves of a light: " + status.message);
    }
    depths.emplace_back(d[0], d[1], d[2], glm::dot(glm::dvec3(d[0], d[1], d[2]), origin) + d[3]);
  }
  bindTexture(CurvesUnit, GL_TEXTURE_2D_ARRAY, light.curves.texture, nearest_);
  GLint size = 0;
  gl().GetTexLevelParameteriv(GL_TEXTURE_2D_ARRAY, 0, GL_TEXTURE_WIDTH, &size);
  program.set("curveDepth", depths);
  program.set("curveSize", static_cast<float>(size));
}

} // namespace host
