#include "AirlightSweep.h"

#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tests {

using namespace tyndall;

namespace {

constexpr double kNear = 1e-3;

// Pixels: distances along rows, from 1e-2 to 1e5, directions across the field of view along columns.
struct Grid {
  int distances, directions;
};

// Layers take the reference long.
Grid gridOf(const Medium& medium) { return medium.layers.empty() ? Grid{29, 16} : Grid{15, 6}; }

std::vector<float> depthOf(const Grid& grid) {
  std::vector<float> depth;
  for (int row = 0; row < grid.directions; ++row)
    for (int column = 0; column < grid.distances; ++column)
      depth.push_back(static_cast<float>(kNear / (1e-2 * std::pow(10.0, 7.0 * column / (grid.distances - 1)))));
  return depth;
}

const std::vector<Rgb> kExtinctions = {{0, 1e-7F, 1e-6F}, {1e-5F, 1e-4F, 1e-3F}, {0.01F, 0.03F, 0.1F},
                                       {0.3F, 1, 3},      {10, 30, 100},         {0, 0.1F, 100}};

std::vector<double> truthOf(FrameRig& rig) { return rig.reference().inscatter.rgb; }

// How far the truth itself moves, per value, if what the effect has to round to float32 is moved by as much: where a
// ray grazes a cone or ends just behind its wall, or where densities change by many e-folds, that is more than the
// integral's error.
class Conditioning {
public:
  Conditioning(FrameRig& rig, const std::vector<double>& truth) : rig_(rig), truth_(truth), moved_(truth.size(), 0) {
    const bool isSpot = !rig.frame.lights.empty() && rig.frame.lights[0].kind == LightKind::Spot;
    if (isSpot) addLight();
    if (!rig.frame.medium.layers.empty()) addLayers();
    if (isSpot || !rig.frame.medium.layers.empty())
      add([](Frame& frame, double by) { frame.camera.clipFromView[14] *= 1 + by; }); // scales all distances
  }
  const std::vector<double>& moved() const { return moved_; }

private:
  static constexpr double kRounding = 2.4e-7; // four roundings of float32

  void add(const std::function<void(Frame&, double)>& move) {
    const Frame frame = rig_.frame;
    for (const double by : {-kRounding, kRounding}) {
      move(rig_.frame, by);
      const std::vector<double> other = truthOf(rig_);
      for (std::size_t i = 0; i < truth_.size(); ++i)
        moved_[i] += 0.5 * std::abs(other[i] - truth_[i]);
      rig_.frame = frame;
    }
  }

  void addLight() {
    const Vec3& position = rig_.frame.lights[0].position;
    const double distance =
        std::hypot(position[0] - kSweepEye[0], position[1] - kSweepEye[1], position[2] - kSweepEye[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      add([&](Frame& frame, double by) { frame.lights[0].position[axis] += by * distance; });
    add([](Frame& frame, double by) { frame.lights[0].outerConeAngle += by; });
  }

  // Directions, and exponents at the eye.
  void addLayers() {
    for (std::size_t axis = 0; axis < 3; ++axis)
      add([&](Frame& frame, double by) { frame.medium.up[axis] += by; });
    add([](Frame& frame, double by) {
      for (HeightLayer& layer : frame.medium.layers)
        layer.height += by * std::abs(kSweepEye[1] - layer.height);
    });
  }

  FrameRig& rig_;
  const std::vector<double>& truth_;
  std::vector<double> moved_;
};

// A medium whose coefficients are those of another times sigma.
Medium times(Medium medium, const Rgb& sigma) {
  for (std::size_t k = 0; k < 3; ++k) {
    medium.absorption[k] *= sigma[k];
    for (Constituent& c : medium.constituents)
      c.scattering[k] *= sigma[k];
  }
  return medium;
}

} // namespace

Medium mediumOf(Constituent constituent) {
  constituent.scattering = {0.7F, 0.7F, 0.7F};
  Medium medium;
  medium.constituents = {constituent};
  medium.absorption = {0.3F, 0.3F, 0.3F};
  return medium;
}

double errorOf(const AirlightSweep& sweep) {
  const Grid grid = gridOf(sweep.medium);
  FrameRig rig(grid.distances, grid.directions, depthOf(grid));
  rig.frame.camera.viewFromWorld = lookAt({kSweepEye[0], kSweepEye[1], kSweepEye[2]}, {1.3, 2.1, 0});
  rig.frame.camera.clipFromView = reversedInfinite(1.2, 1.7, kNear);
  rig.frame.camera.clipDepth = ClipDepth::ZeroToOne;
  rig.frame.ambient = sweep.ambient;
  if (!reference::isLit(sweep.ambient)) rig.frame.lights = {sweep.light};
  std::vector<double> values, references, slack;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const Rgb& sigma : kExtinctions) {
    rig.frame.medium = times(sweep.medium, sigma);
    append(values, rig.render().inscatter.rgb);
    const std::vector<double> truth = truthOf(rig);
    append(references, truth);
    append(slack, Conditioning(rig, truth).moved());
  }
  const double largest = *std::max_element(references.begin(), references.end());
  REQUIRE(largest > 0);
  // Most values are told apart from wrong ones: what rounding may do to them is little of them.
  std::size_t told = 0;
  for (std::size_t i = 0; i < slack.size(); ++i)
    told += slack[i] <= 1e-2 * std::max(references[i], 1e-12 * largest) ? 1 : 0;
  CHECK(static_cast<double>(told) >= 0.95 * static_cast<double>(slack.size()));
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    REQUIRE(std::isfinite(values[i]));
    const double error =
        std::max(0.0, std::abs(values[i] - references[i]) - slack[i]) / std::max(references[i], 1e-12 * largest);
    if (error > worst) at = i;
    worst = std::max(worst, error);
  }
  const auto distances = static_cast<std::size_t>(grid.distances);
  const std::size_t pixels = distances * static_cast<std::size_t>(grid.directions), pixel = (at / 3) % pixels;
  UNSCOPED_INFO("worst: distance " << pixel % distances << " direction " << pixel / distances << " extinctions "
                                   << at / 3 / pixels << " channel " << at % 3 << ": " << values[at] << " for "
                                   << references[at] << " slack " << slack[at] << ", largest " << largest);
  return worst;
}

} // namespace tests
