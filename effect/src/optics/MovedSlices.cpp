#include "optics/MovedSlices.h"

#include "Rounding.h"
#include "optics/Blocks.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace tyndall::optics {

namespace {

using glm::dvec2;
using glm::dvec3;

// How far off a sample's plane lies what it sees: the centre of its nearest pixel, and of those beside it, which tell
// the slope; of its nearest shadow texel, or of the four of a filter.
constexpr double kPixels = 1.75, kTexels = 0.75, kFilterTexels = 1.5;
constexpr double kPi = glm::pi<double>();
constexpr int kNode = 16; // texels of a row's smallest node

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
    const dvec3 across = glm::cross(dvec3(frame_.farPoint[1]), dvec3(frame_.farPoint[2])); // of the far points' plane
    const double distance =
        std::abs(glm::dot(dvec3(frame_.farPoint[0]), across)) / std::max(glm::length(across), 1e-300);
    return step / std::max(distance, 1e-300) * glm::length(point);
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

// Pixels that a texel of the engine's depth covers, at least one.
double pixelsOfTexel(const Frame& frame) {
  const Rectangle& texels = frame.depth.rectangle;
  if (texels.width <= 0 || texels.height <= 0) return 1;
  return std::max({1.0, static_cast<double>(frame.viewport.width) / texels.width,
                   static_cast<double>(frame.viewport.height) / texels.height});
}

// The corners of a box in two poses, relative to the camera's origin, widened by what samples are taken from.
std::vector<dvec3> hullOf(const MovingObject& object, const Frame& frame, const Planes& planes, const Light& light,
                          const blocks::LightBlock& block) {
  const dvec3 origin = cameraOrigin(frame.camera);
  const double texels = frame.settings.shadowFilter == ShadowFilter::Bilinear ? kFilterTexels : kTexels;
  const double pixels = kPixels * pixelsOfTexel(frame);
  double margin = 0;
  for (const Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
    for (const dvec3& corner : cornersOf(*pose, origin, 0))
      margin = std::max({margin, pixels * planes.pixelAt(corner), texels * texelAt(light, block, corner)});
  std::vector<dvec3> hull;
  for (const Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
    for (const dvec3& corner : cornersOf(*pose, origin, margin))
      hull.push_back(corner);
  return hull;
}

// The planes that meet a hull.
Interval intervalOf(const std::vector<dvec3>& hull, const Planes& planes) {
  std::vector<double> places;
  places.reserve(hull.size());
  for (const dvec3& corner : hull)
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

// Where an image or a map shows a hull: nowhere if it lies behind its eye, anywhere if it reaches there.
struct Shown {
  bool anywhere = false;
  std::vector<dvec2> points;
};

Shown shownBy(const glm::dmat4& matrix, const std::vector<dvec3>& hull) {
  Shown shown;
  std::size_t behind = 0;
  for (const dvec3& corner : hull) {
    const glm::dvec4 at = matrix * glm::dvec4(corner, 1);
    if (at.w > 0)
      shown.points.push_back(dvec2(at) / at.w);
    else if (at.w <= 0)
      ++behind;
  }
  shown.anywhere = shown.points.size() + behind < hull.size() || (behind > 0 && behind < hull.size());
  return shown;
}

// The numbers along a line, dot(along, point) + offset of `count`, between those of points; two more on either side, of
// rounding.
Range numbersOf(const Shown& shown, const dvec2& along, double offset, int count) {
  if (shown.anywhere) return {0, count};
  if (shown.points.empty()) return {};
  double low = 1e300, high = -low;
  for (const dvec2& point : shown.points) {
    const double at = glm::dot(along, point) + offset;
    if (!std::isfinite(at)) return {0, count};
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {static_cast<int>(std::clamp(std::floor(low) - 2, 0.0, 1e9)),
          static_cast<int>(std::clamp(std::ceil(high) + 3, 0.0, static_cast<double>(count)))};
}

// Pixels from those relative to the camera's origin.
glm::dmat4 windowFromCamera(const Frame& frame) {
  const dvec2 half(0.5 * frame.viewport.width, 0.5 * frame.viewport.height);
  const glm::dmat4 windowFromClip(half.x, 0, 0, 0, 0, half.y, 0, 0, 0, 0, 1, 0, half.x, half.y, 0, 1);
  return windowFromClip * toGlm(frame.camera.clipFromView) * toGlm(frame.camera.viewFromWorld) *
         glm::translate(glm::dmat4(1), cameraOrigin(frame.camera));
}

// What of slices' samples and rows an object can have moved.
class Ranges {
public:
  Ranges(const Frame& frame, const Light& light, const blocks::LightBlock& block, const SliceTable& slices)
      : slices_(slices), window_(windowFromCamera(frame)) {
    for (int v = 0; v < block.viewCount && light.shadow.texture != 0; ++v)
      maps_.emplace_back(block.shadowViews[v].texelFromCamera);
  }
  std::size_t views() const { return maps_.size(); }

  void take(const std::vector<dvec3>& hull) {
    inWindow_ = shownBy(window_, hull);
    inMaps_.clear();
    for (const glm::dmat4& map : maps_)
      inMaps_.push_back(shownBy(map, hull));
  }

  Range samples(std::size_t slice) const {
    const glm::dvec4 line(texel(slice, 1));
    return numbersOf(inWindow_, dvec2(line), line.z, static_cast<int>(line.w) + 1);
  }

  // With a row's last texel also those behind it, to the end of a node of 16 (rows.glsl), which look at the map's
  // border.
  Range texels(std::size_t slice, std::size_t view) const {
    const glm::dvec4 row(texel(slice, 2 + 2 * view));
    const dvec2 step(row.z, row.w), along = step / std::max(glm::dot(step, step), 1e-300);
    const int count = std::max(static_cast<int>(texel(slice, 3 + 2 * view).x), 1);
    Range range = numbersOf(inMaps_[view], along, -glm::dot(dvec2(row), along), count);
    if (!range.isEmpty() && range.end == count) range.end = roundedUp(count, kNode);
    return range;
  }

private:
  glm::vec4 texel(std::size_t slice, std::size_t row) const {
    return slices_.texels[row * static_cast<std::size_t>(slices_.slices) + slice];
  }

  const SliceTable& slices_;
  glm::dmat4 window_;
  std::vector<glm::dmat4> maps_;
  Shown inWindow_;
  std::vector<Shown> inMaps_;
};

} // namespace

MovedSlices movedSlices(const Frame& frame, const Light& light, const blocks::LightBlock& block,
                        const SliceTable& slices) {
  const auto count = static_cast<std::size_t>(slices.slices);
  const Planes planes(frame, light, block);
  const bool anywhere = !planes.exist() || count < 3;
  std::vector<double> places(count, 0), steps(count, 0);
  for (std::size_t i = 0; i < count && !anywhere; ++i)
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
  Ranges ranges(frame, light, block, slices);
  MovedSlices result{std::vector<bool>(count, false), std::vector<Range>(count),
                     std::vector<Range>(count * ranges.views())};
  for (const MovingObject& object : frame.objects) {
    const std::vector<dvec3> hull = hullOf(object, frame, planes, light, block);
    const Interval interval = anywhere ? Interval{0, 0, true} : intervalOf(hull, planes);
    ranges.take(hull);
    for (std::size_t i = 0; i < count; ++i) {
      // Both neighbours of what lies between two slices, with some room for the rounding of the slices' ends.
      const double apart = std::abs(planes.difference(places[i], interval.middle));
      if (!interval.all && !(apart <= interval.half + 1.01 * steps[i])) continue;
      result.moved[i] = true;
      result.samples[i] = result.samples[i] | ranges.samples(i);
      for (std::size_t v = 0; v < ranges.views(); ++v)
        result.texels[v * count + i] = result.texels[v * count + i] | ranges.texels(i, v);
    }
  }
  return result;
}

} // namespace tyndall::optics
