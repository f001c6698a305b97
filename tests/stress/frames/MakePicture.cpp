// Size, viewport, lens, pose and depth of a random frame.
#include "Case.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace stress {

namespace {

void makeSize(Case& made, const AxisSet& simple) {
  Rectangle& viewport = made.frame.viewport;
  viewport = {0, 0, 16, 12};
  if (Random random(made.seed, Axis::Size); !simple.has(Axis::Size)) {
    viewport.width = random.integer(8, 24);
    viewport.height = random.integer(8, 18);
    if (random.chance(0.1)) viewport.width = random.integer(1, 3);
    if (random.chance(0.1)) viewport.height = random.integer(1, 3);
    if (random.chance(0.02)) viewport.width = random.integer(60, 150);
  }
  if (Random random(made.seed, Axis::Viewport); !simple.has(Axis::Viewport) && random.chance(0.3)) {
    viewport.x = random.integer(0, 5);
    viewport.y = random.integer(0, 5);
    made.margin = {random.integer(0, 4), random.integer(0, 4)};
  }
}

void makeLens(Case& made, const AxisSet& simple) {
  Lens& lens = made.lens;
  tests::DepthConvention& convention = lens.convention;
  convention.reversed = convention.infinite = true;
  convention.clipDepth = ClipDepth::ZeroToOne;
  convention.near = 0.05;
  convention.far = 100;
  Random random(made.seed, Axis::Lens), family = Random::ofFamily(made.seed, Axis::Lens);
  if (simple.has(Axis::Lens)) return;
  convention.reversed = family.chance(0.5);
  convention.orthographic = family.chance(0.25);
  convention.infinite = !convention.orthographic && family.chance(0.4);
  convention.clipDepth = family.chance(0.5) ? ClipDepth::ZeroToOne : ClipDepth::NegativeOneToOne;
  convention.near = random.logUniform(1e-4, 0.5);
  convention.far = std::max(50.0, convention.near * random.logUniform(10, 1e9));
  if (convention.orthographic) {
    convention.far = random.logUniform(20, 1000);
    if (random.chance(0.3)) convention.near = -random.uniform(0, 10);
    lens.size = random.logUniform(0.1, 30);
  } else {
    const double degrees = random.chance(0.5) ? random.uniform(30, 100) : random.uniform(1, 170);
    lens.size = std::tan(0.5 * glm::radians(degrees));
  }
  if (random.chance(0.2)) lens.shift = {random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
}

void makePose(Case& made, const AxisSet& simple) {
  Camera& camera = made.frame.camera;
  camera.viewFromWorld = tests::lookAt({0, 1, 6}, {0.1, 0.4, 0});
  Random random(made.seed, Axis::Pose);
  if (!simple.has(Axis::Pose)) {
    const glm::dvec3 eye = 4.0 * random.uniform() * random.direction();
    const glm::dvec3 forward = random.chance(0.2)
                                   ? random.pick({glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)})
                                   : random.direction();
    const glm::dvec3 up = random.direction(); // any roll
    camera.viewFromWorld = tests::toMat4(glm::lookAt(eye, eye + forward, up));
  }
  const Rectangle& viewport = made.frame.viewport;
  camera.clipDepth = made.lens.convention.clipDepth;
  camera.clipFromView = made.lens.clipFromView(static_cast<double>(viewport.width) / viewport.height);
}

/// View distances as a pattern has them.
struct Surface {
  enum Kind { Wall, Steps, Noise, Bars, Sky, Touching } kind = Wall;
  double nearest = 3, farthest = 9; ///< view distances
  double skyShare = 0.1;
  glm::dvec2 slope{1, 0.2};

  double at(int x, int y, const Rectangle& viewport, Random& random) const {
    const double u = (x + 0.5) / viewport.width, v = (y + 0.5) / viewport.height;
    const bool isSky = random.chance(skyShare);
    double share = random.uniform(); // always drawn, so that one pixel's kind leaves the next as it is
    if (kind == Sky) return kInfinity;
    if (isSky && kind != Wall) return kInfinity;
    if (kind == Wall) share = std::clamp(slope.x * u + slope.y * v, 0.0, 1.0);
    if (kind == Steps) share = (x / 3 + y / 4) % 5 / 4.0;
    if (kind == Bars) share = x % 4 == 1 ? 0 : 1;
    if (kind == Touching) share *= 1e-3;
    return nearest * std::pow(farthest / nearest, share);
  }
};

void makeSurface(Case& made, const AxisSet& simple) {
  Surface surface;
  Random random(made.seed, Axis::Surface);
  if (!simple.has(Axis::Surface)) {
    surface.kind = random.pick(
        {Surface::Wall, Surface::Wall, Surface::Steps, Surface::Noise, Surface::Bars, Surface::Sky, Surface::Touching});
    surface.skyShare = random.chance(0.5) ? 0 : random.uniform();
    surface.nearest = random.logUniform(0.01, 10);
    surface.farthest = surface.nearest * random.logUniform(1, 100);
    surface.slope = {random.uniform(0, 1), random.uniform(0, 1)};
  }
  const tests::DepthConvention& convention = made.lens.convention;
  const double low = convention.near + 1e-3 * std::abs(convention.near),
               high = convention.infinite ? 1e30 : 0.999 * convention.far;
  const Rectangle& viewport = made.frame.viewport;
  for (int y = 0; y < viewport.height; ++y)
    for (int x = 0; x < viewport.width; ++x) {
      const double distance = surface.at(x, y, viewport, random);
      made.distances.push_back(std::isinf(distance) ? distance : std::clamp(distance, low, high));
      made.depth.push_back(convention.windowDepth(made.distances.back()));
    }
  made.isOdd.assign(made.depth.size(), false);
  if (!simple.has(Axis::Surface) && random.chance(0.1))
    for (int i = 0; i < 3; ++i) {
      const auto pixel = static_cast<std::size_t>(random.integer(0, static_cast<int>(made.depth.size()) - 1));
      made.depth[pixel] = static_cast<float>(random.pick({std::nan(""), kInfinity, -kInfinity, -0.5, 1.5, 1e30}));
      made.isOdd[pixel] = true;
    }
}

} // namespace

void makePicture(Case& made, const AxisSet& simple) {
  makeSize(made, simple);
  makeLens(made, simple);
  makePose(made, simple);
  makeSurface(made, simple);
  if (Random random = Random::ofFamily(made.seed, Axis::DepthForm); !simple.has(Axis::DepthForm)) {
    made.depthForm =
        random.pick({DepthForm::Float, DepthForm::Float, DepthForm::Depth32F, DepthForm::Depth24, DepthForm::Depth16});
    for (const bool odd : made.isOdd)
      if (odd) made.depthForm = DepthForm::Float;
  }
}

} // namespace stress
