#include "Noise.h"

#include "Random.h"
#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double mix(double a, double b, double t) { return a + (b - a) * t; }

double planeNoise(double x, double y, int z) {
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const int ix = static_cast<int>(fx);
  const int iy = static_cast<int>(fy);
  const double u = fade(x - fx);
  const double v = fade(y - fy);
  return mix(mix(hashOf(ix, iy, z), hashOf(ix + 1, iy, z), u), mix(hashOf(ix, iy + 1, z), hashOf(ix + 1, iy + 1, z), u),
             v);
}

/// Turned and doubled, so that the lattices of successive octaves do not line up.
glm::dvec2 nextOctave(const glm::dvec2& p) { return {1.6 * p.x - 1.2 * p.y + 17.3, 1.2 * p.x + 1.6 * p.y - 9.1}; }

} // namespace

double noise(const glm::dvec2& point, int seed) { return 2 * planeNoise(point.x, point.y, seed) - 1; }

double noise(const glm::dvec3& point) {
  const double fz = std::floor(point.z);
  const int iz = static_cast<int>(fz);
  return 2 * mix(planeNoise(point.x, point.y, iz), planeNoise(point.x, point.y, iz + 1), fade(point.z - fz)) - 1;
}

double fractal(const glm::dvec2& point, int octaves, int seed) {
  double sum = 0;
  double weight = 0.5;
  glm::dvec2 p = point;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * noise(p, seed + i);
    weight *= 0.5;
    p = nextOctave(p);
  }
  return sum;
}

double ridged(const glm::dvec2& point, int octaves, int seed) {
  double sum = 0;
  double amplitude = 0.5;
  double weight = 1;
  glm::dvec2 p = point;
  for (int i = 0; i < octaves; ++i) {
    const double crest = 1 - std::abs(noise(p, seed + i));
    const double signal = crest * crest * weight;
    sum += amplitude * signal;
    weight = std::clamp(2 * signal, 0.0, 1.0);
    amplitude *= 0.5;
    p = nextOctave(p);
  }
  return sum;
}

} // namespace scenes
