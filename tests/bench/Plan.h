// What is to be measured: setups, each a scene at one size, and the techniques that run interleaved on it.
#pragma once

#include "Technique.h"

#include <gl/Context.h>
#include <string>
#include <vector>

namespace bench {

/// What Setup::series may be.
inline const std::vector<std::string> kSeries = {"curve", "shadow", "image", "slices", "lights", "density"};

struct Setup {
  std::string series; ///< "curve", or what varies in a scaling series: "shadow", "image", "slices", "lights", "density"
  double x = 0;       ///< the value that varies; 0 in a curve
  std::string scene;
  int width = 1280;
  int height = 720;
  int shadowSize = 4096;
  int lights = 0; ///< of the scene, cycled through if there are fewer; 0: as many as there are
  double density = 1;
  host::ContextKind context = host::ContextKind::Osmesa;
  std::vector<Technique> techniques;

  std::string label() const; ///< one line: scene, sizes, context
};

/// What the command line asks for.
struct Request {
  std::vector<std::string> scenes;
  std::vector<Technique> techniques;
  std::vector<std::pair<int, int>> sizes;
  std::vector<int> shadowSizes;
  std::vector<int> lights;
  std::vector<double> densities;
  std::vector<host::ContextKind> contexts;
};

/// One setup for each combination.
std::vector<Setup> planCurves(const Request& request);

/// The scaling series of the full report.
std::vector<Setup> planScaling(host::ContextKind context);

} // namespace bench
