#include "Optics.h"

#include <algorithm>
#include <cmath>

namespace viewer {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kContrast = 0.02;
constexpr float kMostCoefficient = 1e30F;

} // namespace

double phaseOf(const tyndall::Constituent& constituent, double cosTheta) {
  const double g = constituent.g, square = g * g, rayleigh = 1 + cosTheta * cosTheta;
  const double peak = std::pow(1 + square - 2 * g * cosTheta, 1.5);
  switch (constituent.phase) {
  case tyndall::Phase::Isotropic:
    return 1 / (4 * kPi);
  case tyndall::Phase::Rayleigh:
    return 3 / (16 * kPi) * rayleigh;
  case tyndall::Phase::HenyeyGreenstein:
    return 1 / (4 * kPi) * (1 - square) / peak;
  case tyndall::Phase::CornetteShanks:
    return 3 / (8 * kPi) * (1 - square) / (2 + square) * rayleigh / peak;
  }
  return 0;
}

tyndall::Rgb extinctionOf(const tyndall::Medium& medium) {
  tyndall::Rgb extinction = medium.absorption;
  for (const tyndall::Constituent& constituent : medium.constituents)
    for (std::size_t c = 0; c < 3; ++c)
      extinction[c] += constituent.scattering[c];
  return extinction;
}

double visibilityOf(const tyndall::Medium& medium) {
  const tyndall::Rgb extinction = extinctionOf(medium);
  const double mean = (static_cast<double>(extinction[0]) + extinction[1] + extinction[2]) / 3;
  return mean > 0 ? -std::log(kContrast) / mean : tyndall::kInfinity;
}

tyndall::Medium withVisibility(const tyndall::Medium& medium, double visibility) {
  const double now = visibilityOf(medium);
  if (!std::isfinite(now) || !(visibility > 0)) return medium;
  const auto scaled = [&](tyndall::Rgb& rgb) {
    for (float& value : rgb)
      value = std::min(static_cast<float>(value * now / visibility), kMostCoefficient);
  };
  tyndall::Medium result = medium;
  scaled(result.absorption);
  for (tyndall::Constituent& constituent : result.constituents)
    scaled(constituent.scattering);
  return result;
}

} // namespace viewer
