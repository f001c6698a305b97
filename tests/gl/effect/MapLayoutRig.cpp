#include "MapLayoutRig.h"

#include "reference/CameraRays.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;
using host::gl;

namespace tests {

namespace {

GLenum transferOf(GLenum format, int channels) {
  if (channels == 3) return GL_RGB;
  return format == GL_R16F || format == GL_R32F ? GL_RED : format == GL_RG32F ? GL_RG : GL_DEPTH_COMPONENT;
}

GLenum targetOf(Layout layout) {
  switch (layout) {
  case Layout::Atlas:
    return GL_TEXTURE_2D;
  case Layout::Cube:
    return GL_TEXTURE_CUBE_MAP;
  case Layout::CubeArray:
    return GL_TEXTURE_CUBE_MAP_ARRAY;
  default:
    return GL_TEXTURE_2D_ARRAY;
  }
}

} // namespace

LaidMaps::LaidMaps(const reference::ShadowImage& image, Layout layout, float poison, GLenum depthFormat)
    : layout_(layout), tileWidth_(image.width), tileHeight_(image.height) {
  lay(image.layers);
  depth_ = upload(depthFormat, 1, image.depth, poison);
  if (image.glassDepth.empty()) return;
  glassDepth_ = upload(depthFormat, 1, image.glassDepth, poison);
  glassColour_ = upload(GL_RGB32F, 3, image.glassColour, poison);
}

// Tiles with gaps between them, where nothing is even.
void LaidMaps::lay(int views) {
  const bool sheets = layout_ == Layout::Sheets, tiled = sheets || layout_ == Layout::Atlas;
  const bool cubes = layout_ == Layout::CubeArray;
  width_ = tiled ? 2 * (tileWidth_ + 3) + 2 : tileWidth_;
  height_ = tiled ? (sheets ? 1 : 3) * (tileHeight_ + 5) + 1 : tileHeight_;
  layers_ = layout_ == Layout::Atlas ? 1 : sheets ? 4 : cubes ? 12 : views;
  for (int i = 0; i < views; ++i) {
    ShadowView place;
    place.layer = sheets ? 3 - i / 2 : tiled ? 0 : cubes ? 6 + i : i;
    const int row = sheets ? 0 : i / 2;
    if (tiled) place.rectangle = {2 + i % 2 * (tileWidth_ + 3), 1 + row * (tileHeight_ + 5), tileWidth_, tileHeight_};
    places_.push_back(place);
  }
}

host::GlTexture LaidMaps::upload(GLenum internalFormat, int channels, const std::vector<float>& values,
                                 float poison) const {
  const int stored = internalFormat == GL_RG32F ? 2 : channels;
  const auto at = [&](int layer, int x, int y) {
    return static_cast<std::size_t>(stored) * static_cast<std::size_t>((layer * height_ + y) * width_ + x);
  };
  std::vector<float> texels(at(layers_, 0, 0), poison);
  std::size_t next = 0;
  for (const ShadowView& place : places_)
    for (int y = 0; y < tileHeight_; ++y)
      for (int x = 0; x < tileWidth_; ++x, next += static_cast<std::size_t>(channels))
        for (int c = 0; c < channels; ++c)
          texels[at(place.layer, place.rectangle.x + x, place.rectangle.y + y) + static_cast<std::size_t>(c)] =
              values[next + static_cast<std::size_t>(c)];
  host::GlTexture texture = host::makeTexture();
  const GLenum target = targetOf(layout_), transfer = transferOf(internalFormat, channels);
  const auto format = static_cast<GLint>(internalFormat);
  gl().BindTexture(target, texture.name());
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (layout_ == Layout::Atlas)
    gl().TexImage2D(target, 0, format, width_, height_, 0, transfer, GL_FLOAT, texels.data());
  else if (layout_ == Layout::Cube)
    for (int face = 0; face < 6; ++face)
      gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), 0, format, width_, height_, 0,
                      transfer, GL_FLOAT, &texels[at(face, 0, 0)]);
  else
    gl().TexImage3D(target, 0, format, width_, height_, layers_, 0, transfer, GL_FLOAT, texels.data());
  return texture;
}

void LaidMaps::enter(Light& light) const {
  light.shadow.texture = depth_.name();
  light.shadow.array = layout_ != Layout::Atlas && layout_ != Layout::Cube;
  if (glassDepth_) light.glass = {glassColour_.name(), glassDepth_.name()};
  if (layout_ == Layout::Cube || layout_ == Layout::CubeArray) {
    light.shadow.views.clear();
    light.shadow.cube = {true, layout_ == Layout::CubeArray ? 1 : 0, kFaceNear, kFaceFar};
    return;
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    light.shadow.views[i].layer = places_[i].layer;
    light.shadow.views[i].rectangle = places_[i].rectangle;
  }
}

std::vector<ShadowView> faceViews(const Light& light) {
  struct Face {
    glm::dvec3 forward, up;
  };
  const std::array<Face, 6> faces = {{{{1, 0, 0}, {0, -1, 0}},
                                      {{-1, 0, 0}, {0, -1, 0}},
                                      {{0, 1, 0}, {0, 0, 1}},
                                      {{0, -1, 0}, {0, 0, -1}},
                                      {{0, 0, 1}, {0, -1, 0}},
                                      {{0, 0, -1}, {0, -1, 0}}}};
  const glm::dvec3 position = reference::toVec3(light.position);
  glm::dmat4 projection = glm::perspective(glm::radians(90.0), 1.0, kFaceNear, kFaceFar);
  projection[0][0] = projection[1][1] = 1; // but for rounding
  std::vector<ShadowView> views;
  for (const Face& face : faces)
    views.push_back(
        {toMat4(projection * glm::lookAt(position, position + face.forward, face.up)), static_cast<int>(views.size())});
  return views;
}

namespace {

// A view's rays: from the light, or from its near plane.
struct TexelRay {
  glm::dmat4 clip, world;
  glm::dvec3 origin, direction; // of length 1
  double along = 1;             // of the direction, along the view's axis

  TexelRay(const Light& light, const ShadowView& view, const glm::dvec2& ndc)
      : clip(reference::toMat4(view.clipFromWorld)), world(glm::inverse(clip)) {
    const auto at = [&](const glm::dvec2& p, double z) {
      const glm::dvec4 point = world * glm::dvec4(p, z, 1);
      return glm::dvec3(point) / point.w;
    };
    const glm::dvec3 axis = glm::normalize(at({0, 0}, 0.5) - at({0, 0}, -1));
    const bool lamp = light.kind != LightKind::Directional;
    origin = lamp ? reference::toVec3(light.position) : at(ndc, -1);
    direction = glm::normalize(at(ndc, 0.5) - origin);
    along = glm::dot(direction, axis);
  }
};

} // namespace

double distanceOf(const Light& light, const ShadowView& view, const glm::dvec2& ndc, double depth, Measure measure) {
  const TexelRay ray(light, view, ndc);
  const glm::dvec4 point = ray.world * glm::dvec4(ndc, 2 * depth - 1, 1);
  const double distance = glm::length(glm::dvec3(point) / point.w - ray.origin);
  return measure == Measure::Radial ? distance : distance * ray.along;
}

double depthOf(const Light& light, const ShadowView& view, const glm::dvec2& ndc, double distance, Measure measure) {
  const TexelRay ray(light, view, ndc);
  const double s = measure == Measure::Radial ? distance : distance / ray.along;
  const glm::dvec4 point = ray.clip * glm::dvec4(ray.origin + s * ray.direction, 1);
  return 0.5 + 0.5 * point.z / point.w;
}

bool identical(const reference::Image& a, const reference::Image& b) {
  reference::tellOfComparison(a, b);
  return a.rgb == b.rgb;
}

double relativeError(const reference::Image& image, const reference::Image& truth) {
  return errorWhere(image, truth, [](int, int) { return true; });
}

std::unique_ptr<ShaftRig> layoutRig(LightKind kind, bool glass, int mapSize) {
  auto rig = std::make_unique<ShaftRig>(48, 32);
  Light light = shaftLight(kind);
  if (kind == LightKind::Directional) light.shadow.views = shadowViews(light, 3);
  if (kind == LightKind::Point) light.shadow.views = faceViews(light);
  rig->addLight(light, mapSize, glass);
  return rig;
}

} // namespace tests
