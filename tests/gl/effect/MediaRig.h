// Media and light of the surroundings that tests share, and how a frame's passes are found.
#pragma once

#include "SceneRig.h"

#include <algorithm>

namespace tests::media {

using namespace tyndall;

// A blue zenith, a bright side and a dark ground: nowhere negative, but for what a phase function sharpens.
inline Ambient sky() {
  Ambient ambient;
  ambient.radiance = {0.2F, 0.3F, 0.5F};
  ambient.harmonics = {{{1.0F, 1.2F, 1.6F},
                        {0.3F, 0.4F, 0.6F},
                        {-0.2F, -0.1F, 0.05F},
                        {0.25F, 0.1F, -0.1F},
                        {0.1F, 0.05F, 0},
                        {-0.05F, 0.1F, 0.1F},
                        {0.05F, -0.05F, 0.1F},
                        {0.02F, 0, -0.1F},
                        {0.1F, 0.1F, -0.05F}}};
  return ambient;
}

inline Medium haze() {
  Medium medium;
  medium.constituents = {{{0.03F, 0.04F, 0.05F}, Phase::HenyeyGreenstein, 0.6F}};
  medium.farDistance = 40;
  return medium;
}

// And fog of another phase, and one more layer.
inline Medium layered() {
  Medium medium = haze();
  medium.layers = {{0.5, 0.7}, {1, 4, -1}};
  medium.constituents.push_back({{0.2F, 0.2F, 0.2F}, Phase::Rayleigh, 0, 0});
  medium.constituents.push_back({{0.02F, 0.05F, 0.01F}, Phase::CornetteShanks, -0.3F, 1});
  return medium;
}

inline const std::vector<Technique> kTechniques = {Technique::Exact, Technique::Tree, Technique::Epipolar,
                                                   Technique::LowRank};

inline reference::Image sumOf(const reference::Image& a, const reference::Image& b) {
  reference::Image sum = a;
  for (std::size_t i = 0; i < sum.rgb.size(); ++i)
    sum.rgb[i] += b.rgb[i];
  return sum;
}

inline double meanOf(const reference::Image& image) {
  double sum = 0;
  for (const double value : image.rgb)
    sum += value;
  return sum / static_cast<double>(image.rgb.size());
}

// Null if there is none.
inline const PassStatistics* passNamed(const Statistics& statistics, const std::string& name) {
  const auto found = std::find_if(statistics.passes.begin(), statistics.passes.end(),
                                  [&](const PassStatistics& pass) { return pass.name == name; });
  return found == statistics.passes.end() ? nullptr : &*found;
}

inline bool isDrawn(const Statistics& statistics, const std::string& name) {
  const PassStatistics* pass = passNamed(statistics, name);
  return pass && pass->skipped.empty();
}

} // namespace tests::media
