#include "gl/ShadowLayout.h"

#include "gl/ClipConvention.h"
#include "gl/RenderState.h"
#include "scene/Projection.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace host {

namespace {

constexpr const char* kVertex = R"(#version 330 core
void main() { gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 4.0 * float(gl_VertexID >> 1) - 1.0, 0.0, 1.0); })";

// encoding: -1 a colour, 0 window depth, 1 distance along the axis, 2 distance.
constexpr const char* kFragment = R"(#version 330 core
uniform sampler2DArray maps;
uniform int layer, encoding, size;
uniform vec2 origin;
uniform vec2 ndcDepth; // NDC z is x + y * depth
uniform mat4 lightFromNdc;
uniform vec4 axis;
layout(location = 0) out vec4 outTexel;
void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy - origin);
  outTexel = texelFetch(maps, ivec3(texel, layer), 0);
  if (encoding < 1) return;
  vec4 p = lightFromNdc * vec4((2.0 * vec2(texel) + 1.0) / float(size) - 1.0, ndcDepth.x + ndcDepth.y * outTexel.r, 1.0);
  outTexel = vec4(encoding == 1 ? dot(axis.xyz, p.xyz / p.w) + axis.w : length(p.xyz / p.w));
})";

glm::dvec3 positionAt(const glm::dmat4& worldFromNdc, double z) {
  const glm::dvec4 point = worldFromNdc * glm::dvec4(0, 0, z, 1);
  return glm::dvec3(point) / point.w;
}

} // namespace

struct ShadowLayout::Target {
  bool cube = false, atlas = false;
  int size = 0, across = 1, down = 1, views = 1;

  GlTexture make(GLenum format, GLenum channels) const {
    if (!cube)
      return atlas ? makeTexture2D(format, across * size, down * size) : makeTextureArray(format, size, size, views);
    GlTexture texture = makeTexture();
    gl().BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
    for (GLenum face = 0; face < 6; ++face)
      gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, static_cast<GLint>(format), size, size, 0, channels,
                      GL_FLOAT, nullptr);
    return texture;
  }
  glm::ivec2 tile(int view) const { return atlas ? glm::ivec2(view % across, view / across) * size : glm::ivec2(0); }
};

ShadowLayout::ShadowLayout(const MapForm& form)
    : form_(form), program_("shadow layout", kVertex, kFragment), framebuffer_(makeFramebuffer()),
      empty_(makeVertexArray()) {}

// Each view by itself, into its tile, layer or face.
void ShadowLayout::copy(const tyndall::Light& light, GLuint from, const GlTexture& to, bool isDepth,
                        const Target& target) {
  const bool lamp = light.kind != tyndall::LightKind::Directional;
  const auto encoding =
      lamp || form_.encoding == tyndall::DepthEncoding::Window ? form_.encoding : tyndall::DepthEncoding::Axial;
  gl().BindTexture(GL_TEXTURE_2D_ARRAY, from);
  program_.set("encoding", isDepth ? static_cast<int>(encoding) : -1);
  program_.set("size", target.size);
  const bool zeroToOne = light.shadow.clipDepth == tyndall::ClipDepth::ZeroToOne;
  program_.set("ndcDepth", zeroToOne ? glm::vec2(0, 1) : glm::vec2(-1, 2));
  for (std::size_t i = 0; i < light.shadow.views.size(); ++i) {
    const auto layer = static_cast<int>(i);
    const glm::dmat4 clipFromWorld = fromMat4(light.shadow.views[i].clipFromWorld);
    const ClipConvention convention = clipConventionOf(light, light.shadow.views[i]);
    const glm::dmat4 worldFromNdc = glm::inverse(clipFromWorld);
    const glm::dvec3 near = positionAt(worldFromNdc, ndcNear(convention));
    const glm::dvec3 between = positionAt(worldFromNdc, 0.5 * (ndcNear(convention) + ndcFar(convention)));
    const glm::dvec3 light3(light.position[0], light.position[1], light.position[2]), origin = lamp ? light3 : near;
    program_.set("axis", glm::vec4(glm::vec3(glm::normalize(between - near)), 0));
    program_.set("lightFromNdc", glm::mat4(glm::inverse(glm::translate(clipFromWorld, origin))));
    program_.set("layer", layer);
    const glm::ivec2 tile = target.tile(layer);
    program_.set("origin", glm::vec2(tile));
    if (target.cube || target.atlas)
      gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                target.cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(i) : GL_TEXTURE_2D,
                                to.name(), 0);
    else
      gl().FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, to.name(), 0, layer);
    requireCompleteFramebuffer("shadow layout");
    gl().Viewport(tile.x, tile.y, target.size, target.size);
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

LaidOutMaps ShadowLayout::layOut(tyndall::Light& light, int size) {
  LaidOutMaps maps;
  tyndall::ShadowMap& shadow = light.shadow;
  if (shadow.texture == 0 || shadow.views.empty()) return maps;
  Target target;
  target.cube = form_.layout == MapLayout::Cube && light.kind == tyndall::LightKind::Point;
  target.atlas = form_.layout == MapLayout::Atlas;
  target.size = size;
  target.views = static_cast<int>(shadow.views.size());
  target.across = std::min(target.views, target.views > 4 ? 3 : 2);
  target.down = (target.views + target.across - 1) / target.across;
  resetRenderState();
  gl().Disable(GL_DEPTH_TEST);
  gl().ActiveTexture(GL_TEXTURE0);
  gl().BindSampler(0, 0);
  gl().BindVertexArray(empty_.name());
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl().DrawBuffer(GL_COLOR_ATTACHMENT0);
  program_.use();
  program_.set("maps", 0);
  maps.depth = target.make(GL_R32F, GL_RED);
  copy(light, shadow.texture, maps.depth, true, target);
  if (light.glass.colour != 0) {
    maps.glassColour = target.make(GL_RGBA16F, GL_RGBA);
    maps.glassDepth = target.make(GL_R32F, GL_RED);
    copy(light, light.glass.colour, maps.glassColour, false, target);
    copy(light, light.glass.depth, maps.glassDepth, true, target);
    light.glass = {maps.glassColour.name(), maps.glassDepth.name()};
  }
  gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
  enter(light, target);
  shadow.texture = maps.depth.name();
  return maps;
}

// Where what is, and what its depths mean.
void ShadowLayout::enter(tyndall::Light& light, const Target& target) const {
  tyndall::ShadowMap& shadow = light.shadow;
  const bool sun = light.kind == tyndall::LightKind::Directional;
  shadow.encoding =
      sun && form_.encoding == tyndall::DepthEncoding::Radial ? tyndall::DepthEncoding::Axial : form_.encoding;
  shadow.array = !target.cube && !target.atlas;
  if (target.cube) {
    const ClipConvention convention = clipConventionOf(light, shadow.views.front());
    const glm::dmat4 worldFromNdc = glm::inverse(fromMat4(shadow.views.front().clipFromWorld));
    const glm::dvec3 position(light.position[0], light.position[1], light.position[2]);
    shadow.cube = {true, 0, glm::distance(position, positionAt(worldFromNdc, ndcNear(convention))),
                   glm::distance(position, positionAt(worldFromNdc, ndcFar(convention))), convention.reversed};
    shadow.views.clear();
  }
  for (std::size_t i = 0; target.atlas && i < shadow.views.size(); ++i) {
    const glm::ivec2 tile = target.tile(static_cast<int>(i));
    shadow.views[i].layer = 0;
    shadow.views[i].rectangle = {tile.x, tile.y, target.size, target.size};
  }
}

} // namespace host
