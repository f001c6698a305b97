// Mountains after the TERRAIN scene of Chen et al. 2011: low sun behind ridges and kilometres of haze.
#include "Ground.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

constexpr int kCoarse = 151; ///< points a side before the refinements: 151, 301, 601
constexpr double kSide = 20000;
constexpr double kUplift = 250; ///< metres a step where it is strongest

/// Relative uplift: a ridged range, less towards the border.
std::vector<double> upliftOf(const HeightField& field, double strength) {
  std::vector<double> uplift;
  const double last = field.size - 1;
  for (int y = 0; y < field.size; ++y)
    for (int x = 0; x < field.size; ++x) {
      const glm::dvec2 p(x / last, y / last);
      const glm::dvec2 bent = 4.0 * p + 0.45 * glm::dvec2(fractal(3.0 * p, 3, 11), fractal(3.0 * p, 3, 23));
      const double edge = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
      const double rise = std::clamp(edge / 0.12, 0.0, 1.0);
      uplift.push_back(strength * rise * (0.18 + 1.25 * ridged(bent, 4, 31)));
    }
  return uplift;
}

HeightField mountains() {
  HeightField field;
  field.size = kCoarse;
  field.cell = kSide / (kCoarse - 1);
  for (int y = 0; y < kCoarse; ++y)
    for (int x = 0; x < kCoarse; ++x)
      field.heights.push_back(12 * (1 + fractal({0.11 * x, 0.11 * y}, 4, 3)));
  Rivers rivers;
  rivers.creep = 0.04;
  erode(field, upliftOf(field, kUplift), rivers, 90);
  field = refined(field);
  rivers.creep = 0.08;
  erode(field, upliftOf(field, kUplift), rivers, 16);
  field = refined(field);
  rivers.creep = 0.15;
  erode(field, upliftOf(field, kUplift), rivers, 5);
  for (int y = 0; y < field.size; ++y)
    for (int x = 0; x < field.size; ++x) {
      const double rough = std::clamp(field.at(x, y) / 1500, 0.1, 1.0);
      field.at(x, y) += 60 * rough * (ridged({0.055 * x, 0.055 * y}, 5, 71) - 0.4);
    }
  limitSlope(field, 1.3);
  return field;
}

// Linear colours of the ground, and the brightest, of which they are parts.
const glm::dvec3 kMeadow{0.095, 0.1, 0.05}, kForest{0.035, 0.06, 0.025}, kScree{0.24, 0.22, 0.19},
    kRock{0.19, 0.165, 0.14}, kDarkRock{0.115, 0.1, 0.088}, kSnow{0.82, 0.84, 0.88}, kBrightest{0.9};

/// From 0 to 1 where x goes from -width to width.
double step(double x, double width) {
  const double t = std::clamp(0.5 + 0.5 * x / width, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Forest in the valleys, meadows above it, scree and rock, and snow where it can lie.
glm::dvec3 colourAt(const glm::dvec3& p, const glm::dvec3& normal) {
  const glm::dvec2 place(p.x, p.z);
  const double patches = fractal(place / 900.0, 6, 91), fine = fractal(place / 110.0, 3, 57);
  const double steep = 1 - normal.y + 0.02 * fine, height = p.y + 60 * fine;
  const double wooded = step(0.03 - patches + 0.3 * fine, 0.05) * step(850 + 150 * patches - height, 90);
  const double bare = step(height - 1250 - 300 * patches, 140), cliff = step(steep - 0.2, 0.05);
  const double snowed = step(height - 1750 - 450 * patches, 110) * step(0.32 + 0.1 * patches - steep, 0.05);
  glm::dvec3 colour = glm::mix(kMeadow, kForest, wooded);
  colour = glm::mix(colour, glm::mix(kRock, kScree, step(steep - 0.1, 0.04)), bare);
  colour = glm::mix(colour, glm::mix(kDarkRock, kRock, step(patches + 0.4 * fine, 0.2)), cliff);
  colour *= 1 + 0.25 * fine;
  return glm::mix(colour, kSnow, snowed) / kBrightest;
}

} // namespace

Scene makeTerrain() {
  Scene scene;
  scene.grid = 1.0 / 64;
  Light sun;
  sun.colour = {1.0, 0.8, 0.62};
  sun.intensity = 8;
  sun.direction = {0.74, -0.13, 0.66};
  scene.lights = {sun};
  scene.camera = {{6700, 2420, 7300}, {300, 1050, 400}, 46, 5, 60000};
  scene.constituents = {{"rayleigh", {8e-6, 18.7e-6, 45.7e-6}, 0}, {"henyey-greenstein", glm::dvec3(2.2e-5), 0.75}};
  scene.absorption = glm::dvec3(1e-6);
  scene.sky = {1.1, 1.35, 1.75};

  MeshBuilder mesh(scene);
  mesh.material(scene.add({"ground", kBrightest}));
  paint(mesh, {mountains()}, colourAt);
  return scene;
}

} // namespace scenes
