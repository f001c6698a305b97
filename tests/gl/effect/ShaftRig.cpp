#include "ShaftRig.h"

#include "reference/CameraRays.h"
#include "reference/Metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace tests {

namespace {

struct Box {
  glm::dvec3 low, high;
};

const std::vector<Box>& boxes() {
  static const std::vector<Box> all = [] {
    std::vector<Box> list = {{{-40, -1, -40}, {40, 0, 40}}};
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.3 + i * glm::quarter_pi<double>();
      const glm::dvec3 middle(7 * std::sin(angle), 0, -7 * std::cos(angle));
      list.push_back({middle - glm::dvec3(0.5, 0, 0.5), middle + glm::dvec3(0.5, 4 + i % 3, 0.5)});
    }
    for (int i = -4; i < 4; ++i)
      list.push_back({{2.4 * i + 0.3, 7, -10}, {2.4 * i + 1.7, 7.3, 10}});
    return list;
  }();
  return all;
}

// A lattice of coloured panes below the slats.
constexpr double kGlassHeight = 6;

float glassColour(const glm::dvec3& p, int channel) {
  const int pane = static_cast<int>(std::floor(p.x / 2.5) + 3 * std::floor(p.z / 2.5));
  return 0.2F + 0.2F * static_cast<float>((pane + 100 + channel) % 5);
}

struct Texel {
  float depth = 1, glassDepth = 1;
  std::array<float, 3> colour = {1, 1, 1};
};

// As boxDistance, of the boxes and of cubes that were put between them.
double hitDistance(const std::vector<glm::dmat4>& cubes, const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearest = boxDistance(origin, direction);
  for (const glm::dmat4& worldFromCube : cubes) {
    const glm::dmat4 inverse = glm::inverse(worldFromCube);
    const glm::dvec3 from(inverse * glm::dvec4(origin, 1)), along(inverse * glm::dvec4(direction, 0));
    const glm::dvec3 a = (-1.0 - from) / along, b = (1.0 - from) / along;
    const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
    const double t = std::max({enter.x, enter.y, enter.z});
    if (t > 0 && t < nearest && t <= std::min({leave.x, leave.y, leave.z})) nearest = t;
  }
  return nearest;
}

Texel texelAt(const std::vector<glm::dmat4>& cubes, const glm::dmat4& clipFromWorld, const glm::dmat4& worldFromClip,
              const glm::dvec2& ndc) {
  const glm::dvec4 a = worldFromClip * glm::dvec4(ndc, -1, 1), b = worldFromClip * glm::dvec4(ndc, 1, 1);
  const glm::dvec3 origin = glm::dvec3(a) / a.w, ray = glm::dvec3(b) / b.w - origin;
  const auto depthOf = [&](double t) {
    const glm::dvec4 clip = clipFromWorld * glm::dvec4(origin + t * ray, 1);
    return static_cast<float>(0.5 + 0.5 * clip.z / clip.w);
  };
  Texel texel;
  const double hit = hitDistance(cubes, origin, ray), pane = (kGlassHeight - origin.y) / ray.y;
  if (hit < 1) texel.depth = depthOf(hit);
  if (!(pane > 0 && pane < 1)) return texel;
  texel.glassDepth = depthOf(pane);
  for (int c = 0; c < 3; ++c)
    texel.colour[static_cast<std::size_t>(c)] = glassColour(origin + pane * ray, c);
  return texel;
}

reference::ShadowImage castMaps(const std::vector<glm::dmat4>& cubes, const std::vector<ShadowView>& views, int size,
                                bool glass) {
  reference::ShadowImage image{size, size, static_cast<int>(views.size()), {}, {}, {}};
  for (const ShadowView& view : views) {
    const glm::dmat4 clipFromWorld = reference::toMat4(view.clipFromWorld), inverse = glm::inverse(clipFromWorld);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const Texel texel = texelAt(cubes, clipFromWorld, inverse, 2.0 * (glm::dvec2(x, y) + 0.5) / double(size) - 1.0);
        image.depth.push_back(texel.depth);
        if (!glass) continue;
        image.glassDepth.push_back(texel.glassDepth);
        image.glassColour.insert(image.glassColour.end(), texel.colour.begin(), texel.colour.end());
      }
  }
  return image;
}

Mat4 moved(const Mat4& clip, const glm::dvec2& ndc) {
  return toMat4(glm::translate(glm::dmat4(1), glm::dvec3(ndc, 0)) * reference::toMat4(clip));
}

double meanWhere(const reference::Image& image, const PixelSet& where) {
  double sum = 0, count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (where(x, y)) {
        const glm::dvec3 value = image.at(x, y);
        sum += (value.r + value.g + value.b) / 3;
        ++count;
      }
  return count > 0 ? sum / count : 0;
}

} // namespace

double boxDistance(const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearest = kInfinity;
  for (const Box& box : boxes()) {
    const glm::dvec3 a = (box.low - origin) / direction, b = (box.high - origin) / direction;
    const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
    const double t = std::max({enter.x, enter.y, enter.z});
    if (t > 0 && t < nearest && t <= std::min({leave.x, leave.y, leave.z})) nearest = t;
  }
  return nearest;
}

Light shaftLight(LightKind kind) {
  Light light;
  light.kind = kind;
  light.direction = kind == LightKind::Directional ? Vec3{0.25, -0.6, 1} : Vec3{0.1, -1, -0.3};
  light.position = {-0.6, 6.4, -3.5};
  light.colour = kind == LightKind::Directional ? Rgb{1, 1, 1} : Rgb{20, 20, 20};
  light.outerConeAngle = 0.9;
  light.innerConeAngle = 0.6;
  return light;
}

ShaftRig smallShaftRig(Technique technique) {
  ShaftRig rig(48, 32);
  rig.addLight(shaftLight(LightKind::Directional), 64);
  rig.scene.frame.settings.technique = technique;
  return rig;
}

std::vector<ShadowView> shadowViews(const Light& light, int cascades) {
  if (light.kind == LightKind::Point) return shadowViewsOf(light);
  const glm::dvec3 direction = glm::normalize(reference::toVec3(light.direction));
  const glm::dvec3 up = std::abs(direction.z) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  std::vector<ShadowView> views;
  if (light.kind == LightKind::Spot) {
    const glm::dvec3 position = reference::toVec3(light.position);
    const double angle = std::min(2 * light.outerConeAngle + 0.02, 3.0);
    return {{toMat4(glm::perspective(angle, 1.0, 0.1, 60.0) * glm::lookAt(position, position + direction, up)), 0}};
  }
  for (int i = 0; i < cascades; ++i) {
    const double extent = 16.0 / (1 << (cascades - 1 - i));
    const glm::dvec3 eye = glm::dvec3(0, 2, 0) - 30.0 * direction;
    views.push_back(
        {toMat4(glm::ortho(-extent, extent, -extent, extent, 1.0, 60.0) * glm::lookAt(eye, eye + direction, up)), i});
  }
  return views;
}

double errorWhere(const reference::Image& image, const reference::Image& truth, const PixelSet& where) {
  reference::tellOfComparison(image, truth);
  double sum = 0, count = 0;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const glm::dvec3 error = image.at(x, y) - truth.at(x, y);
      if (!std::isfinite(error.r + error.g + error.b)) return kInfinity;
      if (!where(x, y)) continue;
      sum += glm::dot(error, error) / 3;
      ++count;
    }
  if (sum == 0) return 0;
  const double mean = std::max(meanWhere(truth, where), meanWhere(truth, [](int, int) { return true; }));
  return mean > 0 ? std::sqrt(sum / count) / mean : kInfinity;
}

// ---------------------------------------------------------------------------------------------------------------------

ShaftRig::ShaftRig(int width, int height, RigContext context) : scene(width, height, context) {
  scene.frame.medium.constituents = {{{0.05F, 0.05F, 0.05F}, Phase::HenyeyGreenstein, 0.4F}};
  scene.frame.medium.farDistance = 40;
  const double diagonal = std::hypot(width, height); // one sample a pixel is all that a slice can have
  scene.frame.settings.samples = std::clamp(64 * static_cast<int>(diagonal / 64 + 1), 64, 1024);
  look(lookAt({0, 2, 0}, {0, 2, -1}));
}

void ShaftRig::look(const Mat4& viewFromWorld) {
  scene.frame.camera.viewFromWorld = viewFromWorld;
  seeBoxes();
}

void ShaftRig::setConvention(const DepthConvention& convention) {
  scene.setConvention(convention);
  seeBoxes();
}

void ShaftRig::seeBoxes() {
  const Frame& frame = scene.frame;
  const reference::CameraRays rays(frame.camera, frame.viewport.width, frame.viewport.height);
  const glm::dmat4 viewFromWorld = reference::toMat4(frame.camera.viewFromWorld);
  scene.distances.clear();
  for (int y = 0; y < frame.viewport.height; ++y)
    for (int x = 0; x < frame.viewport.width; ++x) {
      const reference::Ray ray = rays.ray(x, y);
      const double hit = hitDistance(moving_, ray.origin, ray.direction);
      scene.distances.push_back(std::isfinite(hit) ? -(viewFromWorld * glm::dvec4(ray.at(hit), 1)).z : kInfinity);
    }
  const Mat4 clipFromView = frame.camera.clipFromView; // a test may have set its own
  scene.setConvention(scene.convention());
  scene.frame.camera.clipFromView = clipFromView;
  changed();
}

Light& ShaftRig::addLight(const Light& light, int mapSize, bool glass) {
  scene.addLight(light.kind, Casters::None);
  Light& added = scene.frame.lights.back();
  added = light;
  if (added.shadow.views.empty()) added.shadow.views = shadowViews(light);
  scene.setShadow(scene.frame.lights.size() - 1, castMaps(moving_, added.shadow.views, mapSize, glass));
  maps_.push_back({mapSize, glass});
  changed();
  return added;
}

void ShaftRig::setMoving(const std::vector<glm::dmat4>& worldFromCube) {
  moving_ = worldFromCube;
  for (std::size_t i = 0; i < maps_.size(); ++i)
    scene.setShadow(i, castMaps(moving_, scene.frame.lights[i].shadow.views, maps_[i].size, maps_[i].glass));
  seeBoxes();
}

void ShaftRig::changed() {
  truth_ = {};
  displaced_.clear();
}

reference::Image ShaftRig::picture(Technique technique) {
  scene.frame.settings.technique = technique;
  return scene.render().inscatter;
}

const reference::Image& ShaftRig::truth() {
  if (truth_.rgb.empty()) truth_ = picture(Technique::Exact);
  return truth_;
}

const std::vector<reference::Image>& ShaftRig::displaced() {
  if (!displaced_.empty()) return displaced_;
  const Frame frame = scene.frame;
  bool suns = true;
  for (const Light& light : frame.lights)
    suns = suns && light.kind == LightKind::Directional;
  for (const glm::dvec2& half : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) { // in NDC of one pixel or texel: half of 2
    if (suns) { // a lamp's brightness would move with the picture
      Mat4& clip = scene.frame.camera.clipFromView;
      clip = moved(clip, half / glm::dvec2(frame.viewport.width, frame.viewport.height));
      displaced_.push_back(picture(Technique::Exact));
      scene.frame = frame;
    }
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      for (ShadowView& view : scene.frame.lights[i].shadow.views)
        view.clipFromWorld =
            moved(view.clipFromWorld, half / glm::dvec2(scene.shadow(i).width, scene.shadow(i).height));
    displaced_.push_back(picture(Technique::Exact));
    scene.frame = frame;
  }
  return displaced_;
}

ShaftError ShaftRig::error(const reference::Image& image, const PixelSet& where) {
  ShaftError result;
  for (const reference::Image& moved : displaced())
    result.displaced = std::max(result.displaced, errorWhere(moved, truth(), where));
  result.rRmse = errorWhere(image, truth(), where); // the last comparison, which a failing test shows
  return result;
}

ShaftError ShaftRig::error(const reference::Image& image) {
  return error(image, [](int, int) { return true; });
}

} // namespace tests
