#include "optics/Jitter.h"

#include <algorithm>
#include <cmath>

namespace tyndall::optics {

namespace {

// Moves what is drawn by so many pixels: by a part of clip w.
Camera moved(const Camera& camera, const Rectangle& viewport, double x, double y) {
  Camera result = camera;
  if (x == 0 && y == 0) return result;
  for (std::size_t column = 0; column < 16; column += 4) {
    result.clipFromView[column] += 2 * x / viewport.width * camera.clipFromView[column + 3];
    result.clipFromView[column + 1] += 2 * y / viewport.height * camera.clipFromView[column + 3];
  }
  return result;
}

double most(const Camera& camera) { return std::max(std::abs(camera.jitter[0]), std::abs(camera.jitter[1])); }

} // namespace

Camera steady(const Camera& camera, const Rectangle& viewport) {
  return moved(camera, viewport, -camera.jitter[0], -camera.jitter[1]);
}

Camera jittered(const Camera& steady, const Rectangle& viewport) {
  return moved(steady, viewport, steady.jitter[0], steady.jitter[1]);
}

bool agree(const Camera& a, const Camera& b) {
  constexpr double kRounding = 1e-6; // of an entry of size 1, which is the image's half width
  if (a.viewFromWorld != b.viewFromWorld || a.clipDepth != b.clipDepth) return false;
  if (most(a) == 0 && most(b) == 0) return a.clipFromView == b.clipFromView;
  return std::equal(a.clipFromView.begin(), a.clipFromView.end(), b.clipFromView.begin(), [](double x, double y) {
    return x == y || std::abs(x - y) <= kRounding * std::max({std::abs(x), std::abs(y), 1.0});
  });
}

double slicesBeyond(const Camera& camera) {
  constexpr double kHalf = 0.5, kMost = 16, kRounding = 1e-6; // of the engine's
  const double jitter = most(camera);
  return jitter == 0 ? 0 : jitter <= kHalf + kRounding ? kHalf : kMost;
}

} // namespace tyndall::optics
