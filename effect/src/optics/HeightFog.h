// What of a medium is the same everywhere, and what thins out with height (Medium::layers).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <tyndall/tyndall.h>

namespace tyndall::optics {

inline constexpr int kEverywhere = -1; ///< a layer: of what is the same everywhere

/// Sums of the coefficients that follow a layer, or none, where density is 1; 1/world unit.
glm::dvec3 scatteringOf(const Medium& medium, int layer);
glm::dvec3 extinctionOf(const Medium& medium, int layer);

/// True if any coefficient but 0 follows a layer.
bool isLayered(const Medium& medium);

/// A layer's density at x, relative to an origin: exp(-max(dot(gradient, x) + offset, ground)).
struct Density {
  glm::dvec3 gradient{0};
  double offset = 0;
  double ground = -60; ///< at least that

  double exponentAt(const glm::dvec3& x) const { return std::max(glm::dot(gradient, x) + offset, ground); }
  double at(const glm::dvec3& x) const { return std::exp(-exponentAt(x)); }
};
Density densityOf(const Medium& medium, int layer, const glm::dvec3& origin);

/// Extinction at the point that shader positions are relative to, 1/world unit.
glm::dvec3 extinctionAtEye(const Medium& medium, const Camera& camera);

/// Per channel the largest integral of density times transmittance along a ray of a length from the origin on, over all
/// that scatters: what an epipolar texture may have to hold of a sun. 0 of a channel that does not scatter.
glm::dvec3 longestWay(const Medium& medium, const glm::dvec3& origin, double length);

/// By how many times the medium may be denser where it is bright than where density is 1, for a lamp at a point
/// relative to the origin. 1 without layers.
double greatestDensity(const Medium& medium, const glm::dvec3& origin, const glm::dvec3& lamp);

} // namespace tyndall::optics
