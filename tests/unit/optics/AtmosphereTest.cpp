// Earth's air (tyndall/atmosphere.h) against integrals over a round Earth.
#include "optics/Matrices.h"
#include "support/Catch.h"

#include <cmath>
#include <functional>
#include <tyndall/atmosphere.h>

using namespace tyndall;

namespace {

constexpr double kRadius = 6.36e6, kPi = 3.14159265358979;

// Along a ray that leaves the ground, or a height, by an elevation.
double integral(const std::function<double(double)>& densityAtHeight, double begin, double elevation, double end) {
  constexpr int kSteps = 200000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) { // finer where the ray begins
    const auto at = [&](double x) { return end * x * x; };
    const double from = at(i / double(kSteps)), to = at((i + 1) / double(kSteps)), s = 0.5 * (from + to);
    const double r = kRadius + begin, away = std::sqrt(r * r + s * s + 2 * r * s * std::sin(elevation));
    sum += (to - from) * densityAtHeight(away - kRadius);
  }
  return sum;
}

double molecules(double height) { return std::exp(-height / 8000); }
double aerosols(double height) { return std::exp(-height / 1200); }
double ozone(double height) { return std::max(0.0, 1 - std::abs(height - 25000) / 15000); }

} // namespace

TEST_CASE("the air is two layers of a medium, in whatever unit of length") {
  for (const double metre : {1.0, 0.01, 39.37}) {
    Atmosphere atmosphere;
    atmosphere.metre = metre;
    atmosphere.seaLevel = 12 * metre;
    atmosphere.haze = 2;
    atmosphere.up = {0, 0, 3};
    const Medium air = airOf(atmosphere);
    CAPTURE(metre);
    REQUIRE(air.layers.size() == 2);
    REQUIRE(air.constituents.size() == 2);
    CHECK(air.up == atmosphere.up);
    CHECK(air.layers[0].scale == Approx(8000 * metre));
    CHECK(air.layers[1].scale == Approx(1200 * metre));
    CHECK(air.layers[0].height == atmosphere.seaLevel);
    CHECK(air.farDistance == Approx(1e5 * metre));
    CHECK(air.absorptionLayer == 1);
    // What stands above the sea, whatever the unit: of molecules at 550 nm 0.108, of aerosols 0.0053 in clear weather.
    CHECK(double(air.constituents[0].scattering[1]) * air.layers[0].scale == Approx(0.1085).epsilon(1e-3));
    CHECK(double(air.constituents[1].scattering[1] + air.absorption[1]) * air.layers[1].scale ==
          Approx(2 * 0.00533).epsilon(1e-3));
  }
}

TEST_CASE("the sun's light through the air is that of an integral over a round Earth") {
  const glm::dvec3 rayleigh(5.802e-6, 13.558e-6, 33.1e-6), absorbed(0.65e-6, 1.881e-6, 0.085e-6);
  for (const double haze : {0.0, 1.0, 5.0})
    for (const double height : {0.0, 2000.0, 5000.0, 8000.0, 11000.0})
      for (const double degrees : {90.0, 45.0, 20.0, 10.0, 5.0, 2.0, 0.0}) {
        const double elevation = degrees * kPi / 180, end = 1.2e6;
        const double m = integral(molecules, height, elevation, end), a = integral(aerosols, height, elevation, end),
                     o = integral(ozone, height, elevation, end);
        Atmosphere atmosphere;
        atmosphere.metre = 0.1;
        atmosphere.haze = haze;
        atmosphere.seaLevel = 7;
        const Rgb through = sunThroughAir(atmosphere, 7 + 0.1 * height, elevation);
        for (int c = 0; c < 3; ++c) {
          const double depth = rayleigh[c] * m + haze * 4.44e-6 * a + absorbed[c] * o;
          CAPTURE(haze, height, degrees, c, depth);
          const double found = -std::log(double(through[static_cast<std::size_t>(c)]));
          if (depth < 80) CHECK(found == Approx(depth).epsilon(degrees >= 10 ? 0.01 : 0.04));
        }
      }
  CHECK(sunThroughAir({}, 0, -0.01) == Rgb{0, 0, 0});
  CHECK(sunThroughAir({}, 0, std::nan("")) == Rgb{0, 0, 0});
}

TEST_CASE("what a flat ground adds to level rays is what the header says") {
  const auto more = [](const std::function<double(double)>& density, double length) {
    return length / integral(density, 0, 0, length) - 1;
  };
  CHECK(more(molecules, 1e5) == Approx(0.03).margin(0.005));
  CHECK(more(aerosols, 1e5) == Approx(0.22).margin(0.02));
  CHECK(more(molecules, 3e4) == Approx(0.003).margin(0.001));
  CHECK(more(aerosols, 3e4) == Approx(0.02).margin(0.005));
}
