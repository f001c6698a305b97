// Poses that a camera and a light come through one after the other, in steps that get as small as 1e-6 where something
// about them changes: where the light crosses an edge of the picture or the plane of the eye, the eye a cone's wall.
#pragma once

#include "gl/effect/ShaftRig.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sweeps {

/// A scene and its poses. `t` is what moves: pixels, degrees or world units; what is special lies at 0.
struct Sweep {
  std::string name;
  std::string unit;
  std::vector<double> at; ///< ascending
  std::function<std::unique_ptr<tests::ShaftRig>()> make;
  std::function<void(tests::ShaftRig& rig, double t)> pose;
};

/// -1 … -1e-6, 0, 1e-6 … 1 times the greatest, a decade apart, and `even` even steps to each side beyond that.
std::vector<double> ladder(double greatest, int even = 0);

/// All of them.
std::vector<Sweep> allSweeps();

} // namespace sweeps
