#include "optics/MovedSlices.h"

#include "optics/Blocks.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall::optics {

namespace {

using glm::dvec2;
using glm::dvec3;

// How far off a sample's plane lies what it sees: the centre of its nearest pixel, and of those beside it, which tell
// the slope; of its nearest shadow texel, or of the four of a filter.
constexpr double kPixels = 1.75, kTexels = 0.75, kFilterTexels = 1.5;
constexpr double kPi = glm::pi<double>();

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

// An interval of angles, or of offsets where planes are parallel.
struct Interval {
  double middle = 0, half = 0;
  bool all = false;
};

// The half-planes of slices: their angle around the line through eye and light; with an orthographic camera the line
// runs through the lamp along the view, and with a directional light the planes are parallel.
class Planes {
public:
  Planes(const Frame& frame, const Light& light, const blocks::LightBlock& block)
      : frame_(frameBlock(frame, {})), orthographic_(frame_.isOrthographic != 0) {
    const bool directional = light.kind == LightKind::Directional;
    const dvec3 toLight = directional ? -dvec3(block.lightDirection) : dvec3(block.lightPosition);
    parallel_ = orthographic_ && directional;
    const dvec3 view(-dvec3(frame_.nearStep));
    dvec3 axis = toLight;
    if (orthographic_) {
      axis = parallel_ ? glm::cross(toLight, view) : view;
      if (!parallel_) origin_ = toLight;
    }
    const double length = glm::length(axis);
    exists_ = length > 1e-12 * (1 + glm::length(toLight)) && (!parallel_ || length > 1e-9 * glm::length(view));
    if (!exists_) return;
    axis_ = axis / length;
    const dvec3 other = std::abs(axis_.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    right_ = glm::normalize(glm::cross(axis_, other));
    up_ = glm::cross(axis_, right_);
  }

  // False where every plane is every other: a light at the eye, a sun along an orthographic view.
  bool exist() const { return exists_; }
  bool parallel() const { return parallel_; }

  // The place of a point, relative to the camera's origin; of a window position's ray.
  double placeOf(const dvec3& point) const {
    if (parallel_) return glm::dot(point, axis_);
    const dvec3 from = point - origin_;
    return std::atan2(glm::dot(from, up_), glm::dot(from, right_));
  }
  double placeAt(const dvec2& window) const {
    const dvec2 p = window - 0.5 * dvec2(frame_.frameSize);
    return placeOf(dvec3(frame_.farPoint[0]) + p.x * dvec3(frame_.farPoint[1]) + p.y * dvec3(frame_.farPoint[2]));
  }

  // World size of a pixel at a point: the largest in the image.
  double pixelAt(const dvec3& point) const {
    const double step = std::max(glm::length(dvec3(frame_.farPoint[1])), glm::length(dvec3(frame_.farPoint[2])));
    if (orthographic_) return step;
    return step / std::max(glm::length(dvec3(frame_.farPoint[0])), 1e-300) * glm::length(point);
  }

  double difference(double a, double b) const { return parallel_ ? a - b : wrapped(a - b); }

private:
  blocks::FrameBlock frame_;
  bool orthographic_, parallel_ = false, exists_ = false;
  dvec3 origin_{0}, axis_{0}, right_{0}, up_{0};
};

// World size of a shadow texel at a point, across the light: the largest over the views.
double texelAt(const Light& light, const blocks::LightBlock& block, const dvec3& point) {
  double size = 0;
  for (int v = 0; v < block.viewCount && light.shadow.texture != 0; ++v) {
    const glm::dmat4 rows = glm::transpose(glm::dmat4(block.shadowViews[v].texelFromCamera));
    const dvec3 forward(rows[3]);
    const double along = glm::dot(forward, forward);
    const double w = along > 0 ? std::abs(glm::dot(forward, point) + rows[3].w) : std::abs(rows[3].w);
    for (int axis = 0; axis < 2; ++axis) {
      dvec3 across(rows[axis]);
      if (along > 0) across -= forward * (glm::dot(across, forward) / along);
      size = std::max(size, w / std::max(glm::length(across), 1e-300));
    }
  }
  return size;
}

// A box's corners, relative to the camera's origin, after its faces have moved outward by `margin`.
std::array<dvec3, 8> cornersOf(const Mat4& worldFromBox, const dvec3& cameraOrigin, double margin) {
  const glm::dmat4 m = toGlm(worldFromBox);
  std::array<dvec3, 3> axes = {dvec3(m[0]), dvec3(m[1]), dvec3(m[2])};
  const std::array<dvec3, 3> before = axes;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 normal = glm::normalize(glm::cross(before[(i + 1) % 3], before[(i + 2) % 3]));
    axes[i] *= 1 + margin / std::max(std::abs(glm::dot(normal, before[i])), 1e-300);
  }
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = dvec3(m[3]) - cameraOrigin + ((i & 1) != 0 ? 1.0 : -1.0) * axes[0] +
                 ((i & 2) != 0 ? 1.0 : -1.0) * axes[1] + ((i & 4) != 0 ? 1.0 : -1.0) * axes[2];
  return corners;
}

// The planes that meet the hull of a box in two poses.
Interval intervalOf(const MovingObject& object, const Frame& frame, const Planes& planes, const Light& light,
                    const blocks::LightBlock& block) {
  const dvec3 origin = cameraOrigin(frame.camera);
  const double texels = frame.settings.shadowFilter == ShadowFilter::Bilinear ? kFilterTexels : kTexels;
  double margin = 0;
  for (const Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
    for (const dvec3& corner : cornersOf(*pose, origin, 0))
      margin = std::max({margin, kPixels * planes.pixelAt(corner), texels * texelAt(light, block, corner)});
  std::vector<double> places;
  for (const Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
    for (const dvec3& corner : cornersOf(*pose, origin, margin))
      places.push_back(planes.placeOf(corner));
  for (const double place : places)
    if (!std::isfinite(place)) return {0, 0, true};
  std::sort(places.begin(), places.end());
  if (planes.parallel()) return {0.5 * (places.front() + places.back()), 0.5 * (places.back() - places.front()), false};
  // What the widest gap between angles leaves; the line itself meets the hull unless that is half a turn.
  double gap = 2 * kPi + places.front() - places.back(), end = places.back();
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    if (places[i + 1] - places[i] > gap) {
      gap = places[i + 1] - places[i];
      end = places[i];
    }
  if (gap <= kPi) return {0, 0, true};
  const double half = 0.5 * (2 * kPi - gap);
  return {end - half, half, false};
}

} // namespace

std::vector<bool> movedSlices(const Frame& frame, const Light& light, const blocks::LightBlock& block,
                              const SliceTable& slices) {
  const auto count = static_cast<std::size_t>(slices.slices);
  const Planes planes(frame, light, block);
  if (!planes.exist() || count < 3) return std::vector<bool>(count, !frame.objects.empty());
  std::vector<double> places(count), steps(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    places[i] = planes.placeAt({slices.texels[i].z, slices.texels[i].w});
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double step = std::abs(planes.difference(places[i + 1], places[i]));
    steps[i] = std::max(steps[i], step);
    steps[i + 1] = std::max(steps[i + 1], step);
  }
  if (slices.block.slicesClosed != 0) {
    const double step = std::abs(planes.difference(places.front(), places.back()));
    steps.front() = std::max(steps.front(), step);
    steps.back() = std::max(steps.back(), step);
  }
  std::vector<bool> moved(count, false);
  for (const MovingObject& object : frame.objects) {
    const Interval interval = intervalOf(object, frame, planes, light, block);
    if (interval.all) return std::vector<bool>(count, true);
    // Both neighbours of what lies between two slices, with some room for the rounding of the slices' ends.
    for (std::size_t i = 0; i < count; ++i)
      if (std::abs(planes.difference(places[i], interval.middle)) <= interval.half + 1.01 * steps[i]) moved[i] = true;
  }
  return moved;
}

} // namespace tyndall::optics
