#include "optics/HeightFog.h"

#include "optics/Blocks.h"
#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>

namespace tyndall::optics {

using glm::dvec3;

dvec3 scatteringOf(const Medium& medium, int layer) {
  dvec3 sum(0);
  for (const Constituent& c : medium.constituents)
    if (c.layer == layer) sum += dvec3(toGlm(c.scattering));
  return sum;
}

dvec3 extinctionOf(const Medium& medium, int layer) {
  return scatteringOf(medium, layer) + (medium.absorptionLayer == layer ? dvec3(toGlm(medium.absorption)) : dvec3(0));
}

bool isLayered(const Medium& medium) {
  for (int i = 0; i < static_cast<int>(medium.layers.size()); ++i)
    if (extinctionOf(medium, i) != dvec3(0)) return true;
  return false;
}

Density densityOf(const Medium& medium, int layer, const dvec3& origin) {
  const HeightLayer& of = medium.layers[static_cast<std::size_t>(layer)];
  Density density;
  if (!std::isfinite(of.scale)) return density;
  const dvec3 up = directionOf(toGlm(medium.up));
  density.gradient = up / of.scale;
  density.offset = (glm::dot(up, origin) - of.height) / of.scale;
  density.ground = std::max((of.ground - of.height) / of.scale, density.ground);
  return density;
}

dvec3 extinctionAtEye(const Medium& medium, const Camera& camera) {
  dvec3 sum = extinctionOf(medium, kEverywhere);
  for (int i = 0; i < static_cast<int>(medium.layers.size()); ++i)
    sum += densityOf(medium, i, cameraOrigin(camera)).at(dvec3(0)) * extinctionOf(medium, i);
  return sum;
}

dvec3 longestWay(const Medium& medium, const dvec3& origin, double length) {
  dvec3 longest(0);
  for (int i = kEverywhere; i < static_cast<int>(medium.layers.size()); ++i) {
    const dvec3 scattering = scatteringOf(medium, i), extinction = extinctionOf(medium, i);
    double densest = 1;
    if (i != kEverywhere) {
      const Density density = densityOf(medium, i, origin);
      densest = std::exp(-std::max(density.offset - length * glm::length(density.gradient), density.ground));
    }
    for (int c = 0; c < 3; ++c)
      if (scattering[c] > 0) longest[c] = std::max(longest[c], std::min(1 / extinction[c], length * densest));
  }
  return longest;
}

// A lamp lights up to where its own way down through the layer is one optical depth, 1 / (extinction scale) of density.
double greatestDensity(const Medium& medium, const dvec3& origin, const dvec3& lamp) {
  double greatest = scatteringOf(medium, kEverywhere) == dvec3(0) ? 0 : 1;
  for (int i = 0; i < static_cast<int>(medium.layers.size()); ++i) {
    const dvec3 scattering = scatteringOf(medium, i), extinction = extinctionOf(medium, i);
    const Density density = densityOf(medium, i, origin);
    double bright = std::max(density.at(dvec3(0)), density.at(lamp));
    for (int c = 0; c < 3; ++c)
      if (scattering[c] > 0) bright = std::max(bright, glm::length(density.gradient) / extinction[c]);
    if (scattering != dvec3(0)) greatest = std::max(greatest, std::min(bright, std::exp(-density.ground)));
  }
  return greatest > 0 ? greatest : 1;
}

} // namespace tyndall::optics
