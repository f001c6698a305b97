#include "tyndall/atmosphere.h"

#include "optics/Matrices.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace tyndall {

namespace {

// Per metre at sea level, at 680, 550 and 440 nm; metres (Bruneton & Neyret 2008; Bruneton 2017 for ozone).
constexpr double kRadius = 6.36e6, kMolecules = 8000, kAerosols = 1200;
constexpr double kMieScattering = 3.996e-6, kMieAbsorption = 0.444e-6;
constexpr double kLongest = 1e5; // of rays to the sky
const glm::dvec3 kRayleigh(5.802e-6, 13.558e-6, 33.1e-6), kOzone(0.65e-6, 1.881e-6, 0.085e-6);

// What floats do not hold is infinite, and refused by render().
float toFloat(double value) { return value > std::numeric_limits<float>::max() ? INFINITY : static_cast<float>(value); }

Rgb toRgb(const glm::dvec3& v) { return {toFloat(v.x), toFloat(v.y), toFloat(v.z)}; }

// exp(y^2) erfc(y), y >= 0.
double scaledErfc(double y) {
  if (y < 10) return std::exp(y * y) * std::erfc(y);
  return (1 - 0.5 / (y * y)) / (y * std::sqrt(glm::pi<double>()));
}

// How many times as much of a layer lies along the way to the sun as above.
double chapman(double scale, double radius, double sine) {
  const double x = radius / scale;
  return std::sqrt(0.5 * glm::pi<double>() * x) * scaledErfc(std::sqrt(0.5 * x) * sine);
}

// Ozone along the way to the sun, as metres of where it is densest: its layer rises from 10 to 25 km and falls to 40.
double ozoneColumn(double height, double sine) {
  constexpr double kMiddle = 25000, kHalf = 15000;
  constexpr int kSteps = 200;
  const double low = std::max(height, kMiddle - kHalf), step = std::max(kMiddle + kHalf - low, 0.0) / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = low + (i + 0.5) * step, cosine = (kRadius + height) / (kRadius + at);
    sum += step * (1 - std::abs(at - kMiddle) / kHalf) / std::sqrt(1 - cosine * cosine * (1 - sine * sine));
  }
  return sum;
}

} // namespace

Medium airOf(const Atmosphere& atmosphere) {
  const double unit = 1 / atmosphere.metre; // of coefficients
  Medium air;
  air.up = atmosphere.up;
  air.layers = {{atmosphere.seaLevel, kMolecules * atmosphere.metre},
                {atmosphere.seaLevel, kAerosols * atmosphere.metre}};
  air.constituents = {{toRgb(unit * kRayleigh), Phase::Rayleigh, 0, 0},
                      {toRgb(glm::dvec3(unit * atmosphere.haze * kMieScattering)), Phase::CornetteShanks, 0.8F, 1}};
  air.absorption = toRgb(glm::dvec3(unit * atmosphere.haze * kMieAbsorption));
  air.absorptionLayer = 1;
  air.farDistance = kLongest * atmosphere.metre;
  return air;
}

Rgb sunThroughAir(const Atmosphere& atmosphere, double height, double elevation) {
  const double sine = std::sin(elevation);
  if (!(sine >= 0)) return {0, 0, 0};
  const double metres = (height - atmosphere.seaLevel) / atmosphere.metre;
  const auto columnOf = [&](double scale) {
    return scale * std::exp(-metres / scale) * chapman(scale, kRadius + metres, sine);
  };
  const double aerosols = atmosphere.haze * (kMieScattering + kMieAbsorption);
  const glm::dvec3 depth =
      kRayleigh * columnOf(kMolecules) + aerosols * columnOf(kAerosols) + kOzone * ozoneColumn(metres, sine);
  return toRgb(glm::exp(-depth));
}

} // namespace tyndall
