// Mountains from uplift and rivers: the stream power law dh/dt = U - K sqrt(A) S, solved implicitly from the outlets
// up (Braun & Willett 2013), with the drainage found by a priority flood (Barnes et al. 2014).
#pragma once

#include <vector>

namespace scenes {

/// A square grid of heights; its border stays where it is and drains it.
struct HeightField {
  int size = 0;    ///< points a side
  double cell = 1; ///< metres between points
  std::vector<double> heights;
  double& at(int x, int y) {
    return heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
  }
  double at(int x, int y) const {
    return heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
  }
};

struct Rivers {
  double erodibility = 0.4; ///< K dt
  double source = 5e4;      ///< square metres that feed a river; smaller catchments erode less
  double talus = 0.95;      ///< no slope to the point downstream exceeds this, give or take a third by place
  double creep = 0.05;      ///< part of the way to its neighbours' mean that a point slides in a step
};

/// Applies `uplift`, metres a step (one value a point), against the rivers.
void erode(HeightField& field, const std::vector<double>& uplift, const Rivers& rivers, int steps);

/// Lowers points that stand higher than `slope` above a neighbour.
void limitSlope(HeightField& field, double slope);

/// The field with twice as many cells.
HeightField refined(const HeightField& field);

} // namespace scenes
