#include "Compare.h"

#include "reference/CameraRays.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

Mat4 moved(const Mat4& clip, const glm::dvec3& ndc) {
  return tests::toMat4(glm::translate(glm::dmat4(1), ndc) * reference::toMat4(clip));
}

void moveViews(std::vector<Light>& lights, const std::function<glm::dvec3(std::size_t light)>& by) {
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (ShadowView& view : lights[i].shadow.views)
      view.clipFromWorld = moved(view.clipFromWorld, by(i));
}

/// How far from the eye rays begin: those of an orthographic camera anywhere on its near plane.
double farthestOrigin(const Camera& camera) {
  if (camera.clipFromView[15] == 0) return 0; // perspective
  const reference::CameraRays rays(camera, 1, 1);
  const double near = reference::ndcFromDepth(camera.clipDepth, rays.reversed() ? 1 : 0);
  const glm::dmat4 viewFromClip = glm::inverse(reference::toMat4(camera.clipFromView));
  double farthest = 0;
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)})
    farthest = std::max(farthest, glm::length(glm::dvec3(viewFromClip * glm::dvec4(corner, near, 1))));
  return farthest;
}

/// How many times wider than angles a lamp's views are: what rounding of a direction comes to in their NDC.
glm::dvec2 magnification(const Light& light) {
  if (light.kind == LightKind::Directional || light.shadow.views.empty()) return glm::dvec2(1);
  const glm::dmat4 rows = glm::transpose(reference::toMat4(light.shadow.views.front().clipFromWorld));
  const double unit = glm::length(glm::dvec3(rows[3]));
  return glm::max(glm::dvec2(glm::length(glm::dvec3(rows[0])), glm::length(glm::dvec3(rows[1]))) / unit, glm::dvec2(1));
}

} // namespace

void Range::include(const std::vector<double>& values) {
  if (low.empty()) low = high = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    // What is infinite in one of the answers may be anything: a lamp lies on the ray.
    if (!std::isfinite(values[i]) || !std::isfinite(high[i]))
      low[i] = -reference::kInfinity, high[i] = reference::kInfinity;
    else
      low[i] = std::min(low[i], values[i]), high[i] = std::max(high[i], values[i]);
  }
}

double errorBeyond(const std::vector<double>& values, const Range& range, double scale) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) return reference::kInfinity;
    const double error = std::max({range.low[i] - values[i], values[i] - range.high[i], 0.0});
    sum += error * error;
  }
  if (sum == 0) return 0;
  return scale > 0 ? std::sqrt(sum / static_cast<double>(values.size())) / scale : reference::kInfinity;
}

double meanOfFinite(const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (const double value : values)
    if (std::isfinite(value)) sum += value, ++count;
  return count > 0 ? sum / count : 0;
}

std::vector<double> withoutGlare(std::vector<double> values, const Comparable& comparable) {
  constexpr double kGlare = 1e6;
  std::vector<double> brightest; // channel of each pixel that holds light: the others may hold next to nothing
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    if (const double most = std::max({values[i], values[i + 1], values[i + 2]}); most > 0) brightest.push_back(most);
  if (brightest.empty()) return values;
  const auto usual = brightest.begin() + static_cast<std::ptrdiff_t>(3 * brightest.size() / 4);
  std::nth_element(brightest.begin(), usual, brightest.end());
  const double most = comparable.isLampAtEye ? comparable.least : kGlare * std::max(*usual, comparable.least);
  for (double& value : values)
    if (value > most) value = reference::kInfinity;
  return values;
}

std::vector<double> truthOf(const reference::MapScene& scene, const std::vector<glm::ivec2>& pixels,
                            const Comparable& comparable) {
  std::vector<double> values;
  for (const reference::PixelAnswer& answer : reference::mapExact(scene, pixels))
    values.insert(values.end(), {answer.inscatter.r, answer.inscatter.g, answer.inscatter.b});
  return withoutGlare(std::move(values), comparable);
}

Range roundedTruth(const reference::MapScene& scene, const std::vector<glm::ivec2>& pixels,
                   const Comparable& comparable) {
  constexpr double kRounding = 1e-6, kOfFloats = 2e-7, kOfWorld = 1e-14;
  constexpr float kSteps = 2.5e-7F; // two steps of a float
  constexpr int kAnswers = 32;
  const glm::dvec3 eye(glm::inverse(reference::toMat4(scene.camera.viewFromWorld))[3]);
  const double origin = farthestOrigin(scene.camera);
  Random random(scene.lights.size(), Axis::Size);
  const auto any = [&] { return random.uniform(-1, 1) * random.direction(); };
  Range range;
  range.include(truthOf(scene, pixels, comparable));
  // All at once: a ray along the edge of two texels, or through the corner of four, meets any of them.
  for (int i = 0; i < kAnswers; ++i) {
    reference::MapScene other = scene;
    const float steps = kSteps * static_cast<float>(random.uniform(-1, 1));
    for (float& depth : other.depth)
      if (depth != 0 && depth != 1) depth *= 1 + steps;
    moveViews(other.lights, [&](std::size_t light) {
      return any() * glm::max(glm::dvec3(kRounding), kOfFloats * glm::dvec3(magnification(other.lights[light]), 1));
    });
    // Where the light is, relative to the eye, and rays are in its views.
    for (Light& light : other.lights) {
      const glm::dmat4 turned = glm::translate(glm::dmat4(1), eye) *
                                glm::rotate(glm::dmat4(1), kOfFloats * random.uniform(-1, 1), random.direction()) *
                                glm::translate(glm::dmat4(1), -eye);
      for (ShadowView& view : light.shadow.views)
        view.clipFromWorld = tests::toMat4(reference::toMat4(view.clipFromWorld) * turned);
      const glm::dvec3 position = reference::toVec3(light.position);
      const double step = kRounding * (glm::length(position - eye) + origin) + kOfWorld * glm::length(eye);
      light.position = toVec3(position + step * any());
      light.direction = toVec3(glm::normalize(reference::toVec3(light.direction)) + kRounding * any());
    }
    range.include(truthOf(other, pixels, comparable));
  }
  return range;
}

Range displacedExact(CaseRig& rig, const Settings& exact, int rowStep, const Comparable& comparable, int count) {
  Range range;
  const Frame frame = rig.frame;
  Random random(frame.lights.size(), Axis::Size);
  for (int i = 0; i < count; ++i) {
    // Each pixel has a slice at another distance: what lies between matters as much as what lies farthest.
    const auto share = [&] { return i == 0 ? 0 : i < 9 ? random.pick({-0.99, 0.99}) : random.uniform(-0.99, 0.99); };
    const glm::dvec2 halfPixel = glm::dvec2(share(), share()) / glm::dvec2(frame.viewport.width, frame.viewport.height);
    const glm::dvec2 ofTexel = double(rowStep) * glm::dvec2(share(), share());
    rig.frame.camera.clipFromView = moved(frame.camera.clipFromView, glm::dvec3(halfPixel, 0));
    moveViews(rig.frame.lights, [&](std::size_t light) {
      const reference::ShadowImage& map = rig.scene().shadows[light];
      return map.width > 0 ? glm::dvec3(ofTexel / glm::dvec2(map.width, map.height), 0) : glm::dvec3(0);
    });
    range.include(withoutGlare(rig.render(exact).inscatter.rgb, comparable));
    rig.frame = frame;
  }
  return range;
}

} // namespace stress
