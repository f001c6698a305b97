#include "optics/LightVolume.h"

#include "optics/Blocks.h"
#include "optics/HeightFog.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace tyndall::optics {

namespace {

using glm::dvec3;
using glm::dvec4;

// All camera rays: from four corners on without end. A perspective camera's rays begin at the eye, in front of its near
// plane; an orthographic one's on the near plane.
struct ViewVolume {
  std::array<dvec3, 4> begin;     // relative to the camera's origin; the corners in turn
  std::array<dvec3, 4> direction; // unit
  std::array<dvec3, 4> along;     // the same from `begin` to one plane across the view: even over the image
  bool orthographic;

  explicit ViewVolume(const Camera& camera) : orthographic(isOrthographic(toGlm(camera.clipFromView))) {
    const glm::dmat4 viewFromWorld = toGlm(camera.viewFromWorld);
    const glm::dmat4 clip = depthFromClip(camera.clipDepth) * toGlm(camera.clipFromView) * viewFromWorld;
    const glm::dmat4 worldFromClip = glm::inverse(clip);
    const dvec3 origin = cameraOrigin(camera), forward = -dvec3(glm::transpose(viewFromWorld)[2]);
    const double near = isReversed(clip, forward) ? 1 : 0; // read for orthographic cameras only
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = i == 1 || i == 2 ? 1 : -1, y = i >= 2 ? 1 : -1;
      const auto pointAt = [&](double depth) {
        const dvec4 p = worldFromClip * dvec4(x, y, depth, 1);
        return dvec3(p) / p.w - origin;
      };
      begin[i] = orthographic ? pointAt(near) : dvec3(0);
      along[i] = pointAt(0.5) - begin[i];
      direction[i] = glm::normalize(along[i]);
    }
  }

  // Outwards from the side through two corners that are neighbours.
  dvec3 sideNormal(std::size_t corner) const {
    const auto across = [&](std::size_t to) { return orthographic ? begin[to] - begin[corner] : direction[to]; };
    const dvec3 normal = glm::cross(direction[corner], across((corner + 1) % 4));
    return glm::dot(normal, across((corner + 2) % 4)) > 0 ? -normal : normal;
  }

  // The greatest dot(normal, x) over the volume.
  double highest(const dvec3& normal) const {
    constexpr double kRounding = 1e-12; // of a unit normal against a unit direction that it was made from
    double most = -kInfinity;
    for (std::size_t i = 0; i < 4; ++i) {
      if (glm::dot(normal, direction[i]) > kRounding) return kInfinity;
      most = std::max(most, glm::dot(normal, begin[i]));
    }
    return most;
  }
};

// What a light reaches: a ball, or the sector of one within an angle of an axis; without a range, without end.
struct ReachedVolume {
  dvec3 position; // relative to the camera's origin
  dvec3 axis;     // unit
  double angle;   // pi for a ball
  double range;

  ReachedVolume(const Light& light, const Camera& camera)
      : position(toGlm(light.position) - cameraOrigin(camera)), axis(0, -1, 0), angle(glm::pi<double>()),
        range(light.range) {
    if (light.kind != LightKind::Spot) return;
    axis = directionOf(toGlm(light.direction));
    angle = light.outerConeAngle;
  }

  // The least dot(normal, x) over the volume. Of all directions within `angle` of the axis one comes as close to
  // -normal as the angle between them less `angle`; the light itself counts too.
  double lowest(const dvec3& normal) const {
    constexpr double kRounding = 1e-5; // radians that shaders may see a cone wider, in float
    const double between = std::acos(glm::clamp(-glm::dot(normal, axis), -1.0, 1.0));
    const double least = std::max(between - angle - kRounding, 0.0);
    const double towards = least < glm::half_pi<double>() ? range * std::cos(least) : 0.0;
    return glm::dot(normal, position) - towards;
  }
};

// Normals of planes that may lie between the two: across to the nearest point on a side, an edge or the corner of the
// view, and planes that touch the cone. Any plane that does separate them proves it.
std::vector<dvec3> candidates(const ViewVolume& view, const ReachedVolume& light) {
  std::vector<dvec3> normals;
  dvec3 along(0);
  for (const dvec3& direction : view.direction)
    along += direction;
  normals.push_back(-along);
  for (std::size_t i = 0; i < 4; ++i) {
    normals.push_back(view.sideNormal(i));
    const dvec3 away = light.position - view.begin[i];
    normals.push_back(away);
    normals.push_back(away - glm::dot(away, view.direction[i]) * view.direction[i]);
  }
  if (light.angle < glm::pi<double>()) {
    // The axis, and turned from it towards the planes as far as the cone allows: then the plane touches it.
    const double turn = std::max(glm::half_pi<double>() - light.angle - 1e-4, 0.0);
    const std::vector<dvec3> planes = normals;
    normals.push_back(light.axis);
    for (const dvec3& plane : planes) {
      const dvec3 across = plane - glm::dot(plane, light.axis) * light.axis;
      if (const double size = glm::length(across); size > 0)
        normals.push_back(std::cos(turn) * light.axis + std::sin(turn) / size * across);
    }
  }
  return normals;
}

} // namespace

namespace {

// True if a ray meets the volume: tried in directions from the lamp, even in the angle, that end on the ray.
bool meets(const ReachedVolume& light, const dvec3& begin, const dvec3& direction) {
  constexpr int kSteps = 32;
  const double foot = glm::dot(light.position - begin, direction);
  const dvec3 toFoot = begin + foot * direction - light.position;
  const double height = glm::length(toFoot);
  if (height > light.range) return false;
  const double last = std::acos(height / light.range), first = std::max(std::atan2(-foot, height), -last);
  if (first > last) return false; // it lies behind the ray's beginning
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = glm::mix(first, last, static_cast<double>(i) / kSteps);
    const dvec3 towards = std::cos(angle) / std::max(height, 1e-300) * toFoot + std::sin(angle) * direction;
    if (glm::dot(towards, light.axis) >= std::cos(light.angle)) return true;
  }
  return false;
}

} // namespace

LightShare shareOf(const Light& light, const Camera& camera, const Medium& medium) {
  const double scale = light.scatteringScale;
  const double colour = scale * std::max({light.colour[0], light.colour[1], light.colour[2]});
  if (light.kind == LightKind::Directional) {
    const dvec3 extinction = extinctionAtEye(medium, camera);
    double sigma = kInfinity; // of the clearest channel that is dimmed
    for (int c = 0; c < 3; ++c)
      if (extinction[c] > 0) sigma = std::min(sigma, extinction[c]);
    return {1, colour * std::min({medium.farDistance, std::isfinite(sigma) ? 1 / sigma : kInfinity, 1e15})};
  }
  constexpr int kColumns = 16, kRows = 9;
  const ViewVolume view(camera);
  const ReachedVolume reached(light, camera);
  double met = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const double u = (x + 0.5) / kColumns, v = (y + 0.5) / kRows;
      const auto at = [&](const std::array<dvec3, 4>& corners) {
        return glm::mix(glm::mix(corners[0], corners[1], u), glm::mix(corners[3], corners[2], u), v);
      };
      met += meets(reached, at(view.begin), glm::normalize(at(view.along))) ? 1 : 0;
    }
  const double distance = std::max(glm::length(reached.position), 1e-12);
  // What no ray meets may lie between them.
  return {std::max(met, 0.5) / (kColumns * kRows), colour * std::min(2 * reached.angle, glm::pi<double>()) / distance};
}

namespace {

// How near a ray through a pixel's centre comes to a lamp that is half a pixel away, at least.
double halfPixelAt(const dvec3& lamp, const blocks::FrameBlock& block) {
  const dvec3 centre(block.farPoint[0]), x(block.farPoint[1]), y(block.farPoint[2]);
  const double half = 0.5 * std::min(glm::length(x), glm::length(y));
  if (block.isOrthographic != 0) return half;
  double farthest = 0; // of the corners: there a pixel's angle is least
  for (const double side : {-0.5, 0.5})
    farthest = std::max({farthest,
                         glm::length(centre + side * (double(block.frameSize.x) * x + double(block.frameSize.y) * y)),
                         glm::length(centre + side * (double(block.frameSize.x) * x - double(block.frameSize.y) * y))});
  return half * glm::length(centre) / (farthest * farthest) * glm::length(lamp);
}

} // namespace

double brightestInscatter(const Frame& frame, const Light& light) {
  const blocks::FrameBlock block = frameBlock(frame, {});
  const dvec3 origin = cameraOrigin(frame.camera), way = longestWay(frame.medium, origin, 1e300);
  const blocks::LightBlock lamp = lightBlock(frame, light, 0, 0);
  const dvec3 phase = peakPhase(block);
  const double passed = greatestDensity(frame.medium, origin, dvec3(lamp.lightPosition)) * glm::pi<double>() /
                        std::max(halfPixelAt(dvec3(lamp.lightPosition), block), 1e-300);
  const double halfPixel = std::max(halfPixelAt(dvec3(lamp.lightPosition), block), 1e-150);
  const dvec3 fog = peakFog(block) / (light.kind == LightKind::Directional ? 1 : halfPixel * halfPixel);
  double brightest = 0;
  for (int c = 0; c < 3; ++c)
    if (lamp.lightColour[c] > 0)
      brightest =
          std::max(brightest, lamp.lightColour[c] *
                                  (phase[c] * (light.kind == LightKind::Directional ? way[c] : passed) + fog[c]));
  return brightest;
}

bool isOutOfView(const Light& light, const Camera& camera) {
  if (light.kind == LightKind::Directional) return false;
  const ReachedVolume reached(light, camera);
  if (reached.angle > glm::half_pi<double>() && !std::isfinite(reached.range)) return false;
  const ViewVolume view(camera);
  // Shaders find the end of a light's reach in float, from the eye.
  const double margin = 1e-5 * (glm::length(reached.position) + glm::length(view.begin[0]));
  for (const dvec3& candidate : candidates(view, reached)) {
    const double size = glm::length(candidate);
    if (!(size > 0)) continue;
    const dvec3 normal = candidate / size;
    if (reached.lowest(normal) - view.highest(normal) > margin) return true;
  }
  return false;
}

} // namespace tyndall::optics
