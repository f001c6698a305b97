#include "baselines/EpipolarLines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gl/Objects.h>
#include <glm/gtc/type_ptr.hpp>

namespace bench {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

dvec3 epipoleOf(const tyndall::Frame& frame, const tyndall::Light& light) {
  const glm::dmat4 clipFromWorld =
      glm::make_mat4(frame.camera.clipFromView.data()) * glm::make_mat4(frame.camera.viewFromWorld.data());
  const dvec4 clip =
      light.kind == tyndall::LightKind::Directional
          ? clipFromWorld * dvec4(-glm::normalize(dvec3(light.direction[0], light.direction[1], light.direction[2])), 0)
          : clipFromWorld * dvec4(light.position[0], light.position[1], light.position[2], 1);
  const dvec3 window(0.5 * (clip.x + clip.w) * frame.viewport.width, 0.5 * (clip.y + clip.w) * frame.viewport.height,
                     clip.w);
  return window / std::max({std::abs(window.x) / frame.viewport.width, std::abs(window.y) / frame.viewport.height,
                            std::abs(window.z)});
}

/// A point of the border: bottom, right, top and left side in turn from the low corner.
dvec2 pointAt(const dvec2& low, const dvec2& size, double arc) {
  if (arc < size.x) return low + dvec2(arc, 0);
  if (arc < size.x + size.y) return low + dvec2(size.x, arc - size.x);
  if (arc < 2 * size.x + size.y) return low + dvec2(2 * size.x + size.y - arc, size.y);
  return low + dvec2(0, 2 * size.x + 2 * size.y - arc);
}

/// Backwards along the line to the epipole, or to where the line enters the image.
dvec2 entryOf(const dvec3& epipole, const dvec2& low, const dvec2& high, const dvec2& exit) {
  const dvec2 d = (epipole.z < 0 ? -1.0 : 1.0) * (epipole.z * exit - dvec2(epipole));
  double t = std::abs(epipole.z) > 0 ? 1 / std::abs(epipole.z) : 1e300;
  for (int axis = 0; axis < 2; ++axis)
    if (d[axis] != 0) t = std::min(t, (exit[axis] - (d[axis] > 0 ? low : high)[axis]) / d[axis]);
  return glm::clamp(exit - d * std::max(t, 0.0), low, high);
}

} // namespace

EpipolarLines::EpipolarLines(const tyndall::Frame& frame, const tyndall::Light& light, int lines, int samplesPerLine)
    : samples(samplesPerLine) {
  const dvec3 e = epipoleOf(frame, light);
  const dvec2 low(0.5), size = dvec2(frame.viewport.width, frame.viewport.height) - 1.0, high = low + size;
  const double side = e.z < 0 ? -1 : 1;
  const dvec2 atLow = side * (e.z * low - dvec2(e)), atHigh = side * (e.z * high - dvec2(e));
  const std::array<bool, 4> exits = {atLow.y < 0, atHigh.x > 0, atHigh.y > 0, atLow.x < 0};
  const std::array<double, 5> starts = {0, size.x, size.x + size.y, 2 * size.x + size.y, 2 * size.x + 2 * size.y};
  // The sides that lines leave through are neighbours; begin at the one whose predecessor is none of them.
  double begin = 0, length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!exits[i]) continue;
    if (!exits[(i + 3) % 4]) begin = starts[i];
    length += starts[i + 1] - starts[i];
  }
  const double step = length / lines;
  for (int i = 0; i < lines; ++i) {
    const dvec2 exit = pointAt(low, size, std::fmod(begin + (i + 0.5) * step, starts[4]));
    ends.emplace_back(entryOf(e, low, high, exit), exit);
  }
  epipole = glm::vec4(e, side);
  border = glm::vec4(low, high);
  arc = glm::vec4(begin, step, starts[4], exits[0] && exits[1] && exits[2] && exits[3] ? 1 : 0);
}

void EpipolarLines::set(host::Program& program) const {
  program.set("lineEpipole", epipole);
  program.set("lineBorder", border);
  program.set("lineArc", arc);
  program.set("gridSize", glm::vec2(ends.size(), samples));
}

} // namespace bench
