#include "tyndall/atmosphere.h"

#include "optics/Matrices.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall {

namespace {

// Per metre at sea level, at 680, 550 and 440 nm; metres (Bruneton & Neyret 2008; Bruneton 2017 for ozone, whose layer
// rises from 10 to 25 km and falls to 40).
constexpr double kRadius = 6.36e6, kMolecules = 8000, kAerosols = 1200;
constexpr double kMieScattering = 3.996e-6, kMieAbsorption = 0.444e-6;
constexpr double kOzoneColumn = 15000, kOzoneHeight = 25000;
constexpr double kLongest = 1e5; // of rays to the sky
const glm::dvec3 kRayleigh(5.802e-6, 13.558e-6, 33.1e-6), kOzone(0.65e-6, 1.881e-6, 0.085e-6);

Rgb toRgb(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

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

// The same of a thin shell.
double throughShell(double height, double sine) {
  const double cosine = kRadius / (kRadius + height);
  return 1 / std::sqrt(1 - cosine * cosine * (1 - sine * sine));
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
  const glm::dvec3 depth = kRayleigh * columnOf(kMolecules) + aerosols * columnOf(kAerosols) +
                           kOzone * kOzoneColumn * throughShell(kOzoneHeight, sine);
  return toRgb(glm::exp(-depth));
}

} // namespace tyndall
