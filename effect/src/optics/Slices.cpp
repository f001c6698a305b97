#include "optics/Slices.h"

#include "Rounding.h"
#include "optics/Blocks.h"
#include "optics/HeightFog.h"
#include "optics/Jitter.h"
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
using glm::dvec4;

// The border of the image through its outermost pixel centres, as an arc from the low corner: bottom, right, top, left.
// Around a single row or column it is not without width: lines leave one through its ends, too. Or `beyond` pixels
// farther out.
struct Border {
  static constexpr double kThin = 1e-3; // pixels; a slice still runs through the pixels' centres
  dvec2 low, high;
  Border(const dvec2& image, double beyond)
      : low(glm::min(dvec2(0.5), 0.5 * image - 0.5 * kThin) - beyond), high(image - low) {}
  dvec2 size() const { return high - low; }
  double perimeter() const { return 2 * (size().x + size().y); }
  double length(int side) const { return side % 2 == 0 ? size().x : size().y; }
  double start(int side) const {
    double sum = 0;
    for (int i = 0; i < side; ++i)
      sum += length(i);
    return sum;
  }
  dvec2 at(double arc) const {
    arc = std::fmod(arc, perimeter());
    const dvec2 s = size();
    if (arc < s.x) return {low.x + arc, low.y};
    if (arc < s.x + s.y) return {high.x, low.y + (arc - s.x)};
    if (arc < 2 * s.x + s.y) return {high.x - (arc - s.x - s.y), high.y};
    return {low.x, high.y - (arc - 2 * s.x - s.y)};
  }
};

// Homogeneous window position, in pixels, of what the light comes from: the position, or the direction against its
// travel.
dvec3 epipoleOf(const Frame& frame, const Light& light) {
  const glm::dmat4 clipFromWorld = toGlm(frame.camera.clipFromView) * toGlm(frame.camera.viewFromWorld);
  const dvec4 clip = light.kind == LightKind::Directional
                         ? clipFromWorld * dvec4(-directionOf(toGlm(light.direction)), 0)
                         : clipFromWorld * dvec4(toGlm(light.position), 1);
  const dvec3 window(0.5 * (clip.x + clip.w) * frame.viewport.width, 0.5 * (clip.y + clip.w) * frame.viewport.height,
                     clip.w);
  const double size = std::max(
      {std::abs(window.x) / frame.viewport.width, std::abs(window.y) / frame.viewport.height, std::abs(window.z)});
  return size > 0 ? window / size : dvec3(0, 0, 1); // any factor cancels; a light at the eye has no epipole
}

dvec2 directionAt(const dvec3& epipole, const dvec2& p) {
  return (epipole.z < 0 ? -1.0 : 1.0) * (epipole.z * p - dvec2(epipole));
}

// Which sides lines leave the image through; the direction's component across a side is the same all along it.
std::array<bool, 4> exitSides(const dvec3& epipole, const Border& border) {
  const dvec2 low = directionAt(epipole, border.low), high = directionAt(epipole, border.high);
  return {low.y < 0, high.x > 0, high.y > 0, low.x < 0};
}

// The entry of the line that leaves at `exit`: the epipole if it lies in the image, else the point where it comes in.
dvec2 entryOf(const dvec3& epipole, const Border& border, const dvec2& exit) {
  const dvec2 d = directionAt(epipole, exit);
  // Backwards from the exit by a share t of d; the epipole is at t = 1 / |w|.
  // A little before that: at a lamp itself every direction would have a limit of its own.
  double t = std::abs(epipole.z) > 0 ? std::max(1 / std::abs(epipole.z) - EPIPOLE_GAP / glm::length(d), 0.0) : 1e300;
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] > 0) t = std::min(t, (exit[axis] - border.low[axis]) / d[axis]);
    if (d[axis] < 0) t = std::min(t, (exit[axis] - border.high[axis]) / d[axis]);
  }
  return glm::clamp(exit - d * std::max(t, 0.0), border.low, border.high);
}

// The camera ray through a window position, relative to the camera's origin.
struct CameraRays {
  dvec3 origin;
  glm::dmat4 cameraFromClip;
  bool orthographic;
  dvec3 forward; // of an orthographic camera
  dvec2 size;

  explicit CameraRays(const Frame& frame)
      : origin(cameraOrigin(frame.camera)), orthographic(isOrthographic(toGlm(frame.camera.clipFromView))),
        forward(-glm::transpose(toGlm(frame.camera.viewFromWorld))[2]),
        size(frame.viewport.width, frame.viewport.height) {
    const glm::dmat4 clip =
        depthFromClip(frame.camera.clipDepth) * toGlm(frame.camera.clipFromView) * toGlm(frame.camera.viewFromWorld);
    cameraFromClip = glm::inverse(glm::translate(clip, origin));
  }
  // Two points of the ray, homogeneous: where it begins, and its direction.
  void at(const dvec2& window, dvec4& begin, dvec4& direction) const {
    const dvec2 ndc = 2.0 * window / size - 1.0;
    const dvec4 middle = cameraFromClip * dvec4(ndc, 0.5, 1);
    if (!orthographic) {
      begin = dvec4(0, 0, 0, 1);
      direction = dvec4(dvec3(middle) / middle.w, 0);
      return;
    }
    const dvec4 other = cameraFromClip * dvec4(ndc, 0.25, 1);
    begin = middle / middle.w;
    const dvec3 along = dvec3(middle) / middle.w - dvec3(other) / other.w;
    direction = dvec4(glm::dot(along, forward) < 0 ? -along : along, 0); // with reversed depth z falls along the ray
  }
};

struct Row {
  glm::vec4 originStep{0, 0, 1, 0};
  float texels = 0;
};

// A direction in a view's map (homogeneous) of the line that an orthographic camera's slice follows there: of a ray or,
// if that is farther, from where it begins to where another does, which tells more. Along or against a sun rays do not
// move at all.
dvec4 rowDirection(const dvec4& begin, const dvec4& direction, const dvec4& other) {
  const dvec4 end = begin + 4.0 * direction; // as far as the depth range is long
  if (!(begin.w > 0 && end.w > 0 && other.w > 0)) return direction;
  const dvec2 at = dvec2(begin) / begin.w, moved = dvec2(end) / end.w - at, between = dvec2(other) / other.w - at;
  if (glm::dot(moved, moved) >= glm::dot(between, between)) return direction;
  return dvec4(glm::dot(moved, between) < 0 ? -between : between, 0, 0);
}

// A ray of a slice, homogeneous: where it begins, and its direction; of an orthographic camera, also where the ray at
// the slice's other end begins.
struct SliceRays {
  dvec4 begin{0}, direction{0}, otherBegin{0};
};

// The line that all rays of a slice follow in a view's map: through the texel positions of one ray's begin and
// direction, clipped to the map, oriented as the rays run. With oneBegin they all begin there.
Row rowOf(const glm::dmat4& texelFromCamera, const SliceRays& rays, bool oneBegin, const dvec2& size, int step) {
  const dvec4 a = texelFromCamera * rays.begin;
  dvec4 b = texelFromCamera * rays.direction;
  if (!oneBegin) b = rowDirection(a, b, texelFromCamera * rays.otherBegin);
  dvec2 along(b.x * a.w - a.x * b.w, b.y * a.w - a.y * b.w); // the sign of d(x / w), d(y / w)
  const double greater = std::max(std::abs(along.x), std::abs(along.y));
  Row row;
  if (!(greater > 0)) { // the only ray runs along the light: one texel
    const dvec2 p = a.w != 0 ? dvec2(a) / a.w : dvec2(0);
    row.originStep = glm::vec4(glm::floor(p), 1, 0);
    row.texels = 1;
    return row;
  }
  along /= greater;
  // A finite point of the line: the foot of the map's centre on it. line.xy . p + line.z = 0.
  const dvec3 line = glm::cross(dvec3(a.x, a.y, a.w), dvec3(b.x, b.y, b.w));
  const dvec2 normal(line), centre(0.5 * size);
  const double square = glm::dot(normal, normal);
  if (!(square > 0)) return row;
  const dvec2 point = centre - normal * ((glm::dot(normal, centre) + line.z) / square);
  double low = -1e30, high = 1e30;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) continue;
    const double t0 = -point[axis] / along[axis], t1 = (size[axis] - point[axis]) / along[axis];
    low = std::max(low, std::min(t0, t1));
    high = std::min(high, std::max(t0, t1));
  }
  if (!(high > low)) return row; // the line misses the map
  if (oneBegin && a.w > 0) { // rays leave it forwards: whole steps behind it are never read, but for a step of rounding
    const double eye = glm::dot(dvec2(a) / a.w - point, along) / glm::dot(along, along);
    low += glm::clamp(std::floor((eye - low) / step) - 1, 0.0, std::ceil((high - low) / step) - 1) * step;
  }
  row.originStep = glm::vec4(point + low * along, along * static_cast<double>(step));
  row.texels = static_cast<float>(std::ceil(std::min(high - low, std::max(size.x, size.y)) / step));
  return row;
}

// How rows hold depths: in 16 bits where depth is linear in the distance from the light, else as they are.
void setRowCode(blocks::EpipolarBlock& block, const blocks::LightBlock& light, std::size_t views) {
  if (views == 0) return;                          // no rows
  constexpr float kMost = 65535, kFar = kMost - 1; // the greatest code is a texel without a caster
  const bool linear = std::all_of(light.shadowViews, light.shadowViews + views, [](const blocks::MapView& view) {
    const glm::mat4& m = view.texelFromCamera;
    return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0;
  });
  const float near = light.shadowViews[0].nearDepth, far = light.shadowViews[0].farDepth;
  block.rowCodeScale = linear ? kFar / kMost / (far - near) : 1;
  block.rowCodeOffset = linear ? -near * block.rowCodeScale : 0;
  block.emptyRowCode = linear ? 1 : 3e38F;
  block.rowCodeSteps = linear ? kMost : 0;
}

// How epipolar textures hold colours in half floats: the largest that a ray can bring near the upper end of their
// range, so that most of it lies below. A directional light's is the shorter of the mean free path and the longest ray;
// a lamp's, times the sine, is half a turn of the phase function's peak over the lamp's distance, 256 times less than
// the range holds, since a ray of an orthographic camera, or past a lamp beside the eye, comes nearer to it than that.
void setStored(blocks::EpipolarBlock& block, const Frame& frame, const Light& light, const blocks::LightBlock& lamp) {
  constexpr double kLargestHalf = 65504, kCoordinates = 48; // units that lib/stored.glsl has codes for
  const blocks::FrameBlock camera = frameBlock(frame, {});
  const double longest = std::min<double>(farthestEnd(camera), camera.visibleEnd);
  dvec3 scale(0.5 * kLargestHalf / longest);
  double distance = glm::length(dvec3(lamp.lightPosition));
  if (camera.isOrthographic != 0) distance = std::max(distance, 0.5 * glm::length(dvec3(camera.nearStep)));
  distance = std::max(distance, 1e-30);
  if (light.kind == LightKind::Directional && isLayered(frame.medium)) {
    scale = 0.5 * kLargestHalf / glm::max(longestWay(frame.medium, cameraOrigin(frame.camera), longest), 1e-30);
  } else if (light.kind == LightKind::Directional) {
    scale = glm::max(scale, 0.5 * kLargestHalf * dvec3(camera.extinction));
  } else {
    const dvec3 peak = peakPhase(camera);
    scale = dvec3(kLargestHalf / 256 / glm::pi<double>() * distance / std::max({peak.x, peak.y, peak.z}));
    scale /= greatestDensity(frame.medium, cameraOrigin(frame.camera), dvec3(lamp.lightPosition));
  }
  // What fog adds: all of a sun's light within no length; a lamp's as near to it as a ray may come (above), or as fog
  // is to a lamp beside the eye.
  if (camera.isFogLit != 0) {
    const double nearest = std::max({distance / 16, frame.eyeCurves.nearDistance - distance, 1e-15});
    const dvec3 peak = light.kind == LightKind::Directional ? peakFog(camera) / glm::max(leastPhase(camera), 1e-30)
                                                            : peakFog(camera) / (nearest * nearest);
    scale = 1.0 / (dvec3(camera.mediumScatters) / scale + peak / (0.5 * kLargestHalf));
  }
  block.storedScale = glm::clamp(scale, 1e-30, 1e30);
  block.leastCoordinate = static_cast<float>(std::log2(longest) + 2 - kCoordinates);
}

constexpr float kLeastTarget = 1e-4F; // no picture comes as near as that: for less nothing is left out, either

// Slices from which those that are drawn are chosen; 0: all are.
int candidatesOf(const Frame& frame, int visibleSlices, int widest) {
  constexpr int kFewest = 4 * SLICE_BLOCK; // fewer are no choice
  const int slices = frame.settings.slices;
  if (!mayChooseSlices(frame) || std::min({slices, visibleSlices, widest}) < kFewest) return 0;
  return std::min(roundedUp(std::min(2 * slices, visibleSlices), SLICE_BLOCK), widest / SLICE_BLOCK * SLICE_BLOCK);
}

} // namespace

bool mayChooseSlices(const Frame& frame) {
  const Settings& settings = frame.settings;
  return settings.errorTarget > 0 && settings.technique == Technique::Epipolar &&
         !std::isfinite(settings.spreadThreshold) && frame.reuse.changes == Changes::Unknown;
}

SliceSampling samplingOf(const Settings& settings) { return {1, settings.samples, settings.rowStep}; }

SliceTable makeSlices(const Frame& frame, const Light& light, int shadowWidth, int shadowHeight,
                      const SliceSampling& sampling) {
  const int slices = frame.settings.slices, samples = sampling.samples;
  const Border border(dvec2(frame.viewport.width, frame.viewport.height), slicesBeyond(frame.camera));
  const dvec3 epipole = epipoleOf(frame, light);
  const std::array<bool, 4> exits = exitSides(epipole, border);
  // The exit sides are neighbours; the first is one whose predecessor is none.
  int first = 0;
  for (int side = 0; side < 4; ++side)
    if (exits[static_cast<std::size_t>(side)] && !exits[static_cast<std::size_t>((side + 3) % 4)]) first = side;
  const bool closed = exits[0] && exits[1] && exits[2] && exits[3];
  double visible = 0;
  for (int side = 0; side < 4; ++side)
    if (exits[static_cast<std::size_t>(side)]) visible += border.length(side);

  SliceTable table;
  const int visibleSlices = std::max(1, static_cast<int>(std::ceil(visible)));
  const int candidates = candidatesOf(frame, visibleSlices, sampling.widest);
  const int all = candidates > 0 ? candidates : std::min(slices, visibleSlices);
  table.slices = unitsFor(all, sampling.every);
  table.drawn = sampling.every == 1 ? std::min(slices, all) : table.slices;
  const auto count = static_cast<std::size_t>(table.slices);
  const std::size_t views = light.shadow.texture ? light.shadow.views.size() : 0;
  table.rows = static_cast<int>(2 + 2 * views);
  table.texels.assign(count * static_cast<std::size_t>(table.rows), glm::vec4(0));
  const double step = visible / all;
  const blocks::LightBlock lightMatrices = lightBlock(frame, light, shadowWidth, shadowHeight);
  const CameraRays rays(frame);
  for (std::size_t i = 0; i < count; ++i) {
    const double slice = static_cast<double>(i) * sampling.every;
    const dvec2 exit = border.at(border.start(first) + (slice + 0.5) * step);
    const dvec2 entry = entryOf(epipole, border, exit);
    const double length = glm::distance(entry, exit);
    table.texels[i] = glm::vec4(entry, exit);
    const double wanted = std::min(static_cast<double>(samples), std::ceil(length) + 1);
    const dvec2 perPixel = (exit - entry) * ((wanted - 1) / std::max(length * length, 1e-12));
    table.texels[count + i] = glm::vec4(perPixel, -glm::dot(perPixel, entry), wanted - 1);
    table.regularSamples += static_cast<std::uint64_t>(wanted + 15) / 16;
    SliceRays ends;
    rays.at(exit, ends.begin, ends.direction);
    if (dvec4 unused; rays.orthographic) rays.at(entry, ends.otherBegin, unused);
    for (std::size_t v = 0; v < views; ++v) {
      const Row row = rowOf(glm::dmat4(lightMatrices.shadowViews[v].texelFromCamera), ends, !rays.orthographic,
                            dvec2(lightMatrices.shadowViews[v].size), sampling.rowStep);
      table.texels[(2 + 2 * v) * count + i] = row.originStep;
      table.texels[(3 + 2 * v) * count + i] = glm::vec4(row.texels, 0, 0, 0);
      table.longestRow = std::max(table.longestRow, static_cast<int>(row.texels));
    }
  }
  blocks::EpipolarBlock& block = table.block;
  block.epipole = epipole;
  block.epipoleSign = epipole.z < 0 ? -1 : 1;
  block.border = glm::vec4(border.low, border.high);
  block.slicesBegin = static_cast<float>(border.start(first));
  block.sliceWidth = static_cast<float>(step);
  block.borderLength = static_cast<float>(border.perimeter());
  block.slicesClosed = closed ? 1 : 0;
  block.sliceCount = table.drawn;
  block.candidateSlices = all;
  block.samplesPerSlice = samples;
  block.sliceTarget = candidates > 0 && sampling.every == 1 ? std::max(frame.settings.errorTarget, kLeastTarget) : 0;
  setRowCode(block, lightMatrices, views);
  setStored(block, frame, light, lightMatrices);
  return table;
}

} // namespace tyndall::optics
