#include "FrameInput.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace fuzz {

namespace {

using tyndall::Mat4;

constexpr double kPi = 3.141592653589793;

/// Once in 32 times any number, else a sensible one.
double mostly(Numbers& numbers, double low, double high) {
  if (numbers.below(32) == 0) return numbers.real();
  return low + (high - low) * numbers.below(1001) / 1000;
}

/// The same, of any power of ten between two.
double scaled(Numbers& numbers, double lowExponent, double highExponent) {
  if (numbers.below(32) == 0) return numbers.real();
  return std::pow(10.0, lowExponent + (highExponent - lowExponent) * numbers.below(1001) / 1000);
}

int whole(Numbers& numbers, int low, int high) {
  return numbers.below(32) == 0 ? numbers.raw<int>() : low + numbers.below(high - low + 1);
}

template <typename Enumerator>
Enumerator oneOf(Numbers& numbers, int count) {
  return static_cast<Enumerator>(numbers.below(64) == 0 ? numbers.below(256) - 128 : numbers.below(count));
}

glm::dvec3 point(Numbers& numbers) {
  const double size = scaled(numbers, -3, 6);
  const double x = mostly(numbers, -1, 1) * size, y = mostly(numbers, -1, 1) * size;
  return {x, y, mostly(numbers, -1, 1) * size};
}

tyndall::Vec3 vec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

tyndall::Rgb rgb(Numbers& numbers, double lowExponent, double highExponent) {
  tyndall::Rgb colour{};
  const double size = numbers.below(8) == 0 ? 0 : scaled(numbers, lowExponent, highExponent);
  const bool grey = numbers.flag();
  for (float& channel : colour)
    channel = static_cast<float>(grey ? size : size * mostly(numbers, 0, 1));
  return colour;
}

/// A matrix for the effect, of which one element in 64 may be anything.
Mat4 matrix(Numbers& numbers, const glm::dmat4& m) {
  Mat4 result{};
  for (int i = 0; i < 16; ++i)
    result[static_cast<std::size_t>(i)] = m[i / 4][i % 4];
  if (numbers.below(16) == 0) result[static_cast<std::size_t>(numbers.below(16))] = numbers.real();
  if (numbers.below(64) == 0)
    for (double& element : result)
      element = numbers.real();
  return result;
}

glm::dmat4 view(Numbers& numbers, const glm::dvec3& eye, const glm::dvec3& target) {
  const bool isVertical = numbers.below(8) == 0;
  const glm::dmat4 look = glm::lookAt(eye, target, isVertical ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
  if (std::isfinite(look[0][0] + look[1][1] + look[3][0] + look[3][1] + look[3][2])) return look;
  return glm::translate(glm::dmat4(1), -eye);
}

/// Perspective or orthographic; for depth from -1 to 1 or from 0 to 1, reversed or not, its far plane at infinity or
/// not.
glm::dmat4 projection(Numbers& numbers, bool orthographic, tyndall::ClipDepth clipDepth) {
  const double near = scaled(numbers, -4, 2), far = near * (1 + scaled(numbers, -2, 6));
  const double size = orthographic ? scaled(numbers, -2, 5) : std::tan(mostly(numbers, 0.01, 1.5));
  const double aspect = mostly(numbers, 0.2, 5), lowest = clipDepth == tyndall::ClipDepth::ZeroToOne ? 0 : -1;
  const bool reversed = numbers.flag();
  const double atNear = reversed ? 1 : lowest, atFar = reversed ? lowest : 1; // of clip depth
  glm::dmat4 m(0);
  m[0][0] = 1 / (size * aspect);
  m[1][1] = 1 / size;
  if (orthographic) {
    m[2][2] = (atNear - atFar) / (far - near);
    m[3][2] = atNear + m[2][2] * near;
    m[3][3] = 1;
    return m;
  }
  const bool infinite = numbers.flag();
  m[2][2] = infinite ? -atFar : (atNear * near - atFar * far) / (far - near);
  m[3][2] = near * (m[2][2] + atNear) * (infinite ? -1 : 1);
  if (infinite) m[3][2] = near * (atNear - atFar);
  if (!infinite) m[3][2] = far * near * (atNear - atFar) / (far - near);
  m[2][3] = -1;
  if (numbers.below(8) == 0) m[2][0] = mostly(numbers, -1, 1);
  return m;
}

tyndall::Rectangle rectangle(Numbers& numbers) {
  if (numbers.flag()) return {};
  const int x = whole(numbers, 0, 2048), y = whole(numbers, 0, 2048), width = whole(numbers, 1, 2048);
  return {x, y, width, whole(numbers, 1, 2048)};
}

tyndall::DepthScale depthScale(Numbers& numbers, tyndall::DepthEncoding encoding) {
  tyndall::DepthScale scale;
  if (encoding == tyndall::DepthEncoding::Window) return scale;
  if (encoding == tyndall::DepthEncoding::Logarithmic) {
    scale.constant = scaled(numbers, -6, 6);
    scale.farDistance = scaled(numbers, -2, 8);
  } else {
    scale.unit = scaled(numbers, -3, 6);
    scale.offset = numbers.flag() ? 0 : mostly(numbers, -10, 10);
  }
  return scale;
}

tyndall::DepthEncoding encoding(Numbers& numbers) {
  return numbers.flag() ? tyndall::DepthEncoding::Window : oneOf<tyndall::DepthEncoding>(numbers, 4);
}

void addViews(Numbers& numbers, tyndall::Light& light) {
  const bool isSun = light.kind == tyndall::LightKind::Directional, isPoint = light.kind == tyndall::LightKind::Point;
  light.shadow.array = numbers.below(4) != 0;
  light.shadow.clipDepth = oneOf<tyndall::ClipDepth>(numbers, 2);
  light.shadow.encoding = encoding(numbers);
  light.shadow.scale = depthScale(numbers, light.shadow.encoding);
  if (isPoint && numbers.flag()) {
    light.shadow.cube.enabled = true;
    light.shadow.cube.nearDistance = scaled(numbers, -3, 1);
    light.shadow.cube.farDistance = numbers.flag() ? tyndall::kInfinity : scaled(numbers, 1, 6);
    light.shadow.cube.reversedDepth = numbers.flag();
    return;
  }
  const int count = whole(numbers, 1, isSun ? 4 : isPoint ? 6 : 1);
  const glm::dvec3 place(light.position[0], light.position[1], light.position[2]);
  const glm::dvec3 along(light.direction[0], light.direction[1], light.direction[2]);
  for (int i = 0; i < std::min(count, 8); ++i) {
    const glm::dvec3 eye = isSun ? point(numbers) : place, target = eye + (isPoint ? point(numbers) : along);
    tyndall::ShadowView one;
    const glm::dmat4 lens = projection(numbers, isSun && numbers.below(16) != 0, light.shadow.clipDepth);
    one.clipFromWorld = matrix(numbers, lens * view(numbers, eye, target));
    one.layer = light.shadow.array ? i : 0;
    one.rectangle = rectangle(numbers);
    light.shadow.views.push_back(one);
  }
}

tyndall::Light lightOf(Numbers& numbers) {
  tyndall::Light light;
  light.kind = oneOf<tyndall::LightKind>(numbers, 3);
  light.direction = vec(point(numbers));
  light.position = vec(point(numbers));
  light.colour = rgb(numbers, -8, 8);
  if (numbers.flag()) light.range = scaled(numbers, -3, 6);
  light.outerConeAngle = mostly(numbers, 1e-4, kPi / 2);
  light.innerConeAngle = light.outerConeAngle * mostly(numbers, 0, 1);
  light.litOutsideViews = numbers.flag();
  if (light.kind == tyndall::LightKind::Directional) {
    if (numbers.below(4) == 0) light.cascadeFade = mostly(numbers, 0, 0.5);
    light.boundary = {numbers.below(4) == 0, vec(point(numbers)), vec(point(numbers))};
  }
  if (numbers.below(4) == 0) return light;
  light.shadow.texture = 2;
  addViews(numbers, light);
  if (numbers.below(4) == 0) light.glass = {3, 4};
  if (numbers.below(4) == 0)
    light.curves = {5, numbers.below(32) == 0 ? numbers.raw<int>() : 4 + 4 * numbers.below(4), numbers.flag(), 0};
  return light;
}

tyndall::Medium mediumOf(Numbers& numbers) {
  tyndall::Medium medium;
  const int count = whole(numbers, 0, tyndall::kMaxConstituents);
  for (int i = 0; i < std::min(count, 8); ++i) {
    tyndall::Constituent one;
    one.scattering = rgb(numbers, -9, 4);
    one.phase = oneOf<tyndall::Phase>(numbers, 4);
    one.g = static_cast<float>(mostly(numbers, -0.999, 0.999));
    if (numbers.below(4) == 0) one.layer = whole(numbers, -1, tyndall::kMaxHeightLayers - 1);
    medium.constituents.push_back(one);
  }
  medium.absorption = rgb(numbers, -9, 4);
  if (numbers.flag()) medium.farDistance = scaled(numbers, -2, 9);
  for (int i = std::min(whole(numbers, 0, tyndall::kMaxHeightLayers), 8); i > 0; --i)
    medium.layers.push_back({mostly(numbers, -1, 1) * scaled(numbers, -3, 6), scaled(numbers, -3, 9),
                             numbers.flag() ? -tyndall::kInfinity : mostly(numbers, -1, 1) * scaled(numbers, -3, 6)});
  if (numbers.below(4) == 0) medium.absorptionLayer = whole(numbers, -1, tyndall::kMaxHeightLayers - 1);
  if (numbers.flag()) medium.up = vec(point(numbers));
  return medium;
}

tyndall::Ambient ambientOf(Numbers& numbers) {
  tyndall::Ambient ambient;
  ambient.radiance = rgb(numbers, -9, 4);
  if (numbers.flag())
    for (tyndall::Rgb& harmonic : ambient.harmonics)
      for (float& channel : harmonic)
        channel = static_cast<float>(mostly(numbers, -1, 1) * scaled(numbers, -9, 4));
  if (numbers.below(4) == 0) ambient.occlusion = {10, 0};
  return ambient;
}

tyndall::Settings settingsOf(Numbers& numbers) {
  tyndall::Settings settings = tyndall::settingsOf(static_cast<tyndall::Profile>(numbers.below(4)));
  settings.technique = oneOf<tyndall::Technique>(numbers, 4);
  if (numbers.below(8) == 0) settings.debugView = oneOf<tyndall::DebugView>(numbers, 12);
  settings.shadowFilter = oneOf<tyndall::ShadowFilter>(numbers, 2);
  settings.slices = whole(numbers, 1, 24);
  settings.samples = numbers.below(32) == 0 ? numbers.raw<int>() : 64 + 64 * numbers.below(8);
  settings.rowStep = whole(numbers, 1, 8);
  settings.minMaxTree = numbers.flag();
  settings.breakThreshold = static_cast<float>(scaled(numbers, -4, 1));
  settings.bendThreshold = static_cast<float>(scaled(numbers, -4, 1));
  settings.leastWeight = static_cast<float>(mostly(numbers, 0, 1));
  settings.averageThreshold = static_cast<float>(mostly(numbers, 0, 1));
  if (numbers.flag()) settings.spreadThreshold = static_cast<float>(scaled(numbers, -4, 1));
  if (numbers.below(4) == 0) settings.errorTarget = static_cast<float>(mostly(numbers, 0, 1));
  settings.lowRankTerms = whole(numbers, 1, 8);
  if (numbers.below(4) == 0) settings.sampleBudget = whole(numbers, 4096, 1 << 20);
  return settings;
}

glm::dmat4 placement(Numbers& numbers) {
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), point(numbers));
  const glm::dmat4 turned = glm::rotate(moved, mostly(numbers, -kPi, kPi), glm::dvec3(0.6, 0, 0.8));
  return glm::scale(turned, glm::dvec3(scaled(numbers, -3, 3), scaled(numbers, -3, 3), scaled(numbers, -3, 3)));
}

void addObjects(Numbers& numbers, tyndall::Frame& frame) {
  frame.reuse.changes = oneOf<tyndall::Changes>(numbers, 3);
  frame.reuse.fullShare = static_cast<float>(mostly(numbers, 0, 1));
  frame.reuse.refreshFrames = whole(numbers, 0, 100);
  if (frame.reuse.changes != tyndall::Changes::Objects) return;
  for (int i = numbers.below(4); i > 0; --i) {
    tyndall::MovingObject object;
    object.worldFromObject = matrix(numbers, placement(numbers));
    object.lastWorldFromObject = matrix(numbers, placement(numbers));
    if (numbers.below(4) == 0) object.mesh.buffer = 7;
    object.mesh.count = static_cast<std::uint32_t>(whole(numbers, 1, 1000));
    frame.objects.push_back(object);
  }
}

} // namespace

tyndall::Frame frameOf(Numbers& numbers) {
  tyndall::Frame frame;
  frame.viewport = {whole(numbers, 0, 64), whole(numbers, 0, 64), whole(numbers, 1, 2048), whole(numbers, 1, 1280)};
  frame.colour = numbers.below(32) == 0 ? 0 : 1;
  if (numbers.flag()) frame.output.inscatter = 8;
  if (numbers.flag()) frame.output.transmittance = 9;
  frame.camera.clipDepth = oneOf<tyndall::ClipDepth>(numbers, 2);
  const glm::dvec3 eye = point(numbers);
  frame.camera.viewFromWorld = matrix(numbers, view(numbers, eye, eye + point(numbers)));
  frame.camera.clipFromView = matrix(numbers, projection(numbers, numbers.below(4) == 0, frame.camera.clipDepth));
  if (numbers.below(4) == 0) frame.camera.jitter = {mostly(numbers, -0.5, 0.5), mostly(numbers, -0.5, 0.5)};
  frame.depth.texture = 1;
  frame.depth.multisampled = numbers.below(4) == 0;
  frame.depth.rectangle = rectangle(numbers);
  frame.depth.encoding = encoding(numbers);
  frame.depth.scale = depthScale(numbers, frame.depth.encoding);
  frame.medium = mediumOf(numbers);
  frame.settings = settingsOf(numbers);
  for (int i = numbers.below(4); i > 0; --i)
    frame.lights.push_back(lightOf(numbers));
  addObjects(numbers, frame);
  // Last, so that what is in the corpus stays what it was.
  if (numbers.below(2) == 1) frame.ambient = ambientOf(numbers);
  if (numbers.below(8) == 1) frame.medium.dimsBackground = false;
  for (tyndall::Light& light : frame.lights)
    if (numbers.below(8) == 1) light.scatteringScale = static_cast<float>(mostly(numbers, 0, 10));
  if (numbers.below(4) == 1) {
    frame.lookup = {11, 12, scaled(numbers, -3, 9), 0};
    frame.lookup.farDistance = frame.lookup.nearDistance * scaled(numbers, 0, 4);
  }
  if (numbers.below(4) == 1) {
    frame.eyeCurves = {{13, 8, numbers.flag(), 0}, scaled(numbers, -3, 9), 0};
    frame.eyeCurves.farDistance = frame.eyeCurves.nearDistance * scaled(numbers, 0, 4);
    frame.eyeCurves.albedo = {static_cast<float>(scaled(numbers, -3, 1)), 0.5F, 1};
    frame.eyeCurves.dimsBackground = numbers.flag();
  }
  return frame;
}

} // namespace fuzz
