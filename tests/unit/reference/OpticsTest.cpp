#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>
#include <reference/Optics.h>

using namespace reference;
using tyndall::Phase;

namespace {

constexpr double kPi = glm::pi<double>();

tyndall::Medium mediumOf(Phase phase, float g, float scattering, float absorption) {
  tyndall::Medium medium;
  medium.constituents = {{{scattering, scattering, scattering}, phase, g}};
  medium.absorption = {absorption, absorption, absorption};
  return medium;
}

tyndall::Light pointAt(const glm::dvec3& p, double range = kInfinity) {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Point;
  light.position = {p.x, p.y, p.z};
  light.range = range;
  return light;
}

tyndall::Light spotAt(const glm::dvec3& p, const glm::dvec3& d, double inner, double outer) {
  tyndall::Light light = pointAt(p);
  light.kind = tyndall::LightKind::Spot;
  light.direction = {d.x, d.y, d.z};
  light.innerConeAngle = inner;
  light.outerConeAngle = outer;
  return light;
}

/// The integrand as DESIGN states it, in s, without any substitution; red channel.
double density(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray, double s) {
  const glm::dvec3 x = ray.at(s);
  const double sigma = extinction(medium).r;
  glm::dvec3 travel = toVec3(light.direction);
  double strength = 1;
  double path = s;
  if (light.kind != tyndall::LightKind::Directional) {
    travel = x - toVec3(light.position);
    const double r = glm::length(travel);
    if (r > light.range) return 0;
    strength = 1 / (r * r);
    path += r;
    if (light.kind == tyndall::LightKind::Spot)
      strength *= spotFalloff(light, glm::dot(travel / r, glm::normalize(toVec3(light.direction))));
  }
  double scattered = 0;
  for (const tyndall::Constituent& c : medium.constituents)
    scattered += c.scattering[0] * phase(c.phase, c.g, glm::dot(glm::normalize(travel), -ray.direction));
  return light.colour[0] * scattered * strength * std::exp(-sigma * path);
}

/// Midpoint rule with many steps, spaced so that both short and long distances from the foot are resolved.
double brute(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray, double s0, double s1,
             int steps) {
  const glm::dvec3 toLight = toVec3(light.position) - ray.origin;
  const bool point = light.kind != tyndall::LightKind::Directional;
  const double foot = point ? glm::dot(toLight, ray.direction) : 0;
  const double h = point ? glm::length(glm::cross(toLight, ray.direction)) : 1;
  const double u0 = std::asinh((s0 - foot) / h), u1 = std::asinh((s1 - foot) / h);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = u0 + (u1 - u0) * (i + 0.5) / steps;
    sum += density(medium, light, ray, foot + h * std::sinh(u)) * h * std::cosh(u);
  }
  return sum * (u1 - u0) / steps;
}

} // namespace

TEST_CASE("phase functions integrate to 1 over the sphere", "[reference][optics]") {
  const auto integral = [](Phase kind, double g) {
    constexpr int kSteps = 1000000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      sum += phase(kind, g, -1 + 2 * (i + 0.5) / kSteps);
    return sum * 2 / kSteps * 2 * kPi;
  };
  CHECK(integral(Phase::Isotropic, 0) == Approx(1).epsilon(1e-9));
  CHECK(integral(Phase::Rayleigh, 0) == Approx(1).epsilon(1e-9));
  for (const double g : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
    CHECK(integral(Phase::HenyeyGreenstein, g) == Approx(1).epsilon(1e-6));
    CHECK(integral(Phase::CornetteShanks, g) == Approx(1).epsilon(1e-6));
  }
  CHECK(phase(Phase::CornetteShanks, 0, 0.3) == Approx(phase(Phase::Rayleigh, 0, 0.3)));
  CHECK(phase(Phase::HenyeyGreenstein, 0.5, 1) == Approx((1 - 0.25) / (4 * kPi * 0.125)));
}

TEST_CASE("forward scattering brightens the view towards the light", "[reference][optics]") {
  tyndall::Light sun;
  sun.direction = {0, 0, 1};
  const auto medium = mediumOf(Phase::HenyeyGreenstein, 0.7F, 0.1F, 0);
  const double towards = integrate(medium, sun, {{0, 0, 0}, {0, 0, -1}}, 0, 1).r;
  const double away = integrate(medium, sun, {{0, 0, 0}, {0, 0, 1}}, 0, 1).r;
  CHECK(towards / away == Approx(phase(Phase::HenyeyGreenstein, 0.7F, 1) / phase(Phase::HenyeyGreenstein, 0.7F, -1)));
}

TEST_CASE("directional light has its closed form", "[reference][optics]") {
  tyndall::Light sun;
  sun.direction = {0.3, -0.8, 0.1};
  sun.colour = {2, 3, 4};
  const Ray ray{{1, 2, 3}, glm::normalize(glm::dvec3(0.4, -0.2, -1))};
  tyndall::Medium medium = mediumOf(Phase::Isotropic, 0, 0, 0);
  medium.constituents[0].scattering = {0.5F, 0.25F, 0.125F};
  medium.absorption = {0.25F, 0, 0.5F};
  const Rgb endless = integrate(medium, sun, ray, 0, kInfinity);
  CHECK(endless.r == Approx(2 * 0.5 / 0.75 / (4 * kPi)).epsilon(1e-12));
  CHECK(endless.g == Approx(3 / (4 * kPi)).epsilon(1e-12));
  CHECK(endless.b == Approx(4 * 0.125 / 0.625 / (4 * kPi)).epsilon(1e-12));
  const Rgb span = integrate(medium, sun, ray, 1, 3);
  CHECK(span.g == Approx(3 / (4 * kPi) * (std::exp(-0.25) - std::exp(-0.75))).epsilon(1e-12));

  const auto thin = mediumOf(Phase::Isotropic, 0, 1e-12F, 0);
  CHECK(integrate(thin, sun, ray, 5, 5.001).r == Approx(2 * 1e-12F / (4 * kPi) * 0.001).epsilon(1e-9));
  CHECK(integrate(mediumOf(Phase::Isotropic, 0, 0, 0), sun, ray, 0, kInfinity) == Rgb(0));
  CHECK(integrate(mediumOf(Phase::Isotropic, 0, 0, 2), sun, ray, 0, kInfinity) == Rgb(0));
  // Dense and far: all of it comes from the first units, and nothing is 0/0.
  CHECK(integrate(mediumOf(Phase::Isotropic, 0, 100, 0), sun, ray, 0, 1e5).r == Approx(2 / (4 * kPi)).epsilon(1e-12));
}

TEST_CASE("weighted spans of a hundred thousand optical depths see what is next to their bright end",
          "[reference][optics]") {
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  for (const float sigma : {3.0F, 1e3F, 1e5F}) {
    auto medium = mediumOf(Phase::Isotropic, 0, 0.1F * sigma, 0.9F * sigma);
    medium.absorption[1] = 0.01F; // a channel of which all of the span counts
    medium.constituents[0].scattering[1] = 0.002F;
    for (const int kind : {0, 1, 2, 3}) {
      tyndall::Light light;
      light.direction = {0, -1, 0.3};
      if (kind == 1) light.boundary = {true, {0, 0, -20.5}, {0, 0, 1}}; // the far end is the bright one
      if (kind == 2) light = pointAt({0.5 / sigma, 0, 0.1});
      if (kind == 3) light = pointAt({0, 0.1, -3});
      CAPTURE(sigma, kind);
      const Rgb expected = integrate(medium, light, ray, 0, 20);
      const Rgb weighted = Airlight(medium, light, ray).weighted(0, 20, [](double) { return Rgb(1); });
      for (int c = 0; c < 2; ++c)
        CHECK(weighted[c] == Approx(expected[c]).epsilon(1e-6).margin(1e-200));
    }
  }
}

TEST_CASE("a medium boundary attenuates directional light beyond it", "[reference][optics]") {
  tyndall::Light sun;
  sun.direction = {0, -2, 0};
  sun.boundary = {true, {0, 5, 0}, {0, 3, 0}};
  const auto medium = mediumOf(Phase::Isotropic, 0, 0.2F, 0.1F);
  const double sigma = extinction(medium).r, source = 0.2F / (4 * kPi);
  SECTION("level ray, 3 below the plane: one factor") {
    const Ray ray{{0, 2, 0}, {1, 0, 0}};
    CHECK(integrate(medium, sun, ray, 0, kInfinity).r == Approx(source / sigma * std::exp(-3 * sigma)).epsilon(1e-12));
  }
  SECTION("rising ray: the light's path shrinks as the eye's grows, then only the eye's is left") {
    const Ray ray{{0, 2, 0}, {0, 1, 0}};
    const double below = 3 * std::exp(-3 * sigma), above = std::exp(-3 * sigma) / sigma;
    CHECK(integrate(medium, sun, ray, 0, kInfinity).r == Approx(source * (below + above)).epsilon(1e-12));
    const Rgb weighted = Airlight(medium, sun, ray).weighted(0, 9, [](double) { return Rgb(1); });
    CHECK(weighted.r == Approx(integrate(medium, sun, ray, 0, 9).r).epsilon(1e-9));
  }
  SECTION("falling ray: both grow") {
    const Ray ray{{0, 6, 0}, {0, -1, 0}};
    const double above = -std::expm1(-sigma) / sigma, below = std::exp(-sigma) / (2 * sigma);
    CHECK(integrate(medium, sun, ray, 0, kInfinity).r == Approx(source * (above + below)).epsilon(1e-12));
  }
}

TEST_CASE("point light without extinction is the angle over the height", "[reference][optics]") {
  const auto medium = mediumOf(Phase::Isotropic, 0, 1e-20F, 0);
  const double unit = 1e-20F / (4 * kPi);
  for (const double h : {1e-8, 1e-3, 1.0, 1e4}) {
    CAPTURE(h);
    const tyndall::Light light = pointAt({0, h, -10});
    const Ray ray{{0, 0, 0}, {0, 0, -1}};
    for (const Interval span :
         {Interval{0, 20}, Interval{9, 9.01}, Interval{0, 10}, Interval{12, 1e5}, Interval{99999, 1e5}}) {
      CAPTURE(span.begin, span.end);
      const double t0 = span.begin - 10, t1 = span.end - 10;
      const double angle = std::atan2((t1 - t0) * h, h * h + t0 * t1); // atan(t1 / h) - atan(t0 / h)
      CHECK(integrate(medium, light, ray, span.begin, span.end).r == Approx(unit * angle / h).epsilon(1e-9));
    }
    CHECK(integrate(medium, light, ray, 0, kInfinity).r ==
          Approx(unit / h * (std::atan(10 / h) + kPi / 2)).epsilon(1e-9));
  }
}

TEST_CASE("a ray through the point light: finite beside it, infinite on it", "[reference][optics]") {
  const auto thin = mediumOf(Phase::Isotropic, 0, 1e-20F, 0);
  const double unit = 1e-20F / (4 * kPi);
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  const tyndall::Light light = pointAt({0, 0, -10});
  CHECK(integrate(thin, light, ray, 0, 8).r == Approx(unit * (1 / 2.0 - 1 / 10.0)).epsilon(1e-9));
  CHECK(integrate(thin, light, ray, 11, 14).r == Approx(unit * (1 - 1 / 4.0)).epsilon(1e-9));
  CHECK(std::isinf(integrate(thin, light, ray, 8, 14).r));
  // Towards the light the path is 10 whatever s is.
  const auto dense = mediumOf(Phase::Isotropic, 0, 3, 0);
  CHECK(integrate(dense, light, ray, 0, 8).r == Approx(3 / (4 * kPi) * std::exp(-30) * 0.4).epsilon(1e-9));
}

TEST_CASE("adaptive integrals agree with brute quadrature", "[reference][optics]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Phase phases[] = {Phase::Isotropic, Phase::Rayleigh, Phase::HenyeyGreenstein, Phase::CornetteShanks};
  int compared = 0;
  for (int i = 0; i < 48; ++i) {
    const double size = std::pow(10, uniform(random) * 2);
    const float sigma = static_cast<float>(std::pow(10, uniform(random) * 2) / size);
    const auto medium = mediumOf(phases[i % 4], i % 3 ? 0.8F : -0.5F, 0.6F * sigma, 0.4F * sigma);
    const glm::dvec3 position = size * glm::dvec3(uniform(random), uniform(random), uniform(random));
    const glm::dvec3 aim(uniform(random), uniform(random), uniform(random));
    const Ray ray{size * glm::dvec3(uniform(random), uniform(random), 1 + uniform(random)),
                  glm::normalize(glm::dvec3(uniform(random), uniform(random), -1))};
    tyndall::Light light = pointAt(position);
    if (i % 2) light = spotAt(position, aim, 0.3, 0.9);
    if (i % 5 == 0) light.range = size;
    const double s0 = i % 7 ? 0.1 * size : 0, s1 = size * (1 + uniform(random)) + s0;
    const double expected = brute(medium, light, ray, s0, s1, 400000);
    const double result = integrate(medium, light, ray, s0, s1).r;
    CAPTURE(i, size, sigma, expected, result);
    if (expected > 1e-200) {
      // Range ends the integrand by a step, which the brute rule catches only to one part in its number of steps.
      CHECK(result == Approx(expected).epsilon(i % 5 == 0 ? 2e-5 : 1e-7));
      ++compared;
    } else {
      CHECK(result <= 1e-199);
    }
    const Rgb weighted = Airlight(medium, light, ray).weighted(s0, s1, [](double) { return Rgb(1); });
    CHECK(weighted.r == Approx(result).epsilon(1e-6).margin(1e-200));
  }
  CHECK(compared > 30);
}

TEST_CASE("spans add up and extremes stay finite", "[reference][optics]") {
  const Ray ray{{0, 0, 0}, {0, 0, -1}};
  for (const float sigma : {0.0F, 1e-6F, 1.0F, 100.0F})
    for (const double distance : {1e-2, 1.0, 1e3, 1e5})
      for (const double h : {1e-6, 1e-2, 10.0}) {
        CAPTURE(sigma, distance, h);
        const auto medium = mediumOf(Phase::HenyeyGreenstein, 0.9F, sigma, 0.1F * sigma);
        const tyndall::Light light = pointAt({h, 0, -0.3 * distance});
        const Airlight airlight(medium, light, ray);
        const Rgb whole = airlight.span(0, distance);
        CHECK(std::isfinite(whole.r));
        CHECK(whole.r >= 0);
        Rgb parts{0};
        for (int i = 0; i < 100; ++i)
          parts += airlight.span(distance * i / 100, distance * (i + 1) / 100);
        CHECK(parts.r == Approx(whole.r).epsilon(1e-8).margin(1e-280));
      }
}

TEST_CASE("symmetry: an isotropic span seen from either end", "[reference][optics]") {
  // With the light above the middle, swapping eye and end mirrors the span.
  const auto medium = mediumOf(Phase::Rayleigh, 0, 0.3F, 0.2F);
  const tyndall::Light light = pointAt({2, 1.5, -5});
  const Rgb forth = integrate(medium, light, {{2, 0, 0}, {0, 0, -1}}, 0, 10);
  const Rgb back = integrate(medium, light, {{2, 0, -10}, {0, 0, 1}}, 0, 10);
  CHECK(forth.r == Approx(back.r).epsilon(1e-10));
}

TEST_CASE("the scale of the world does not matter", "[reference][optics]") {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.1, -1));
  const auto at = [&](double scale) {
    const auto inverse = static_cast<float>(1 / scale);
    const auto medium = mediumOf(Phase::CornetteShanks, 0.6F, 0.25F * inverse, 0.125F * inverse);
    tyndall::Light light = spotAt(scale * glm::dvec3(1, 3, -4), {0.1, -1, 0.2}, 0.2, 0.6);
    light.range = 5 * scale;
    return integrate(medium, light, {scale * glm::dvec3(0, 1, 0), direction}, 0, 9 * scale).r * scale;
  };
  const double one = at(1);
  CHECK(one > 0);
  // A light of fixed intensity falls with the square of the scale.
  CHECK(at(1024) * 1024 == Approx(one).epsilon(1e-9));
  CHECK(at(1.0 / 1024) / 1024 == Approx(one).epsilon(1e-9));
}

TEST_CASE("cones cut the ray where the angle says", "[reference][optics]") {
  const auto thin = mediumOf(Phase::Isotropic, 0, 1e-20F, 0);
  const double unit = 1e-20F / (4 * kPi);
  const Ray ray{{0, 0, 10}, {0, 0, -1}};
  const double half = glm::radians(30.0);
  SECTION("hard cone, straight down on the ray: from -30 to 30 degrees") {
    const tyndall::Light light = spotAt({0, 2, 0}, {0, -1, 0}, half, half);
    CHECK(integrate(thin, light, ray, 0, 100).r == Approx(unit * 2 * half / 2).epsilon(1e-9));
    const Interval support = Airlight(thin, light, ray).support();
    CHECK(support.begin == Approx(10 - 2 * std::tan(half)).epsilon(1e-12));
    CHECK(support.end == Approx(10 + 2 * std::tan(half)).epsilon(1e-12));
  }
  SECTION("pointing away lights nothing") {
    CHECK(integrate(thin, spotAt({0, 2, 0}, {0, 1, 0}, half, half), ray, 0, 100).r == 0);
  }
  SECTION("a half space") {
    const tyndall::Light light = spotAt({0, 2, 0}, {0, 0, -1}, kPi / 2, kPi / 2);
    CHECK(integrate(thin, light, ray, 0, kInfinity).r == Approx(unit * (kPi / 2) / 2).epsilon(1e-9));
  }
  SECTION("smooth falloff") {
    const tyndall::Light light = spotAt({0, 2, 0}, {0, -1, 0}, 0, half);
    // Angle a from the axis along the ray: integral of ((cos a - c) / (1 - c))^2 da / h.
    const double c = std::cos(half);
    const double integral = half + 0.5 * std::sin(2 * half) - 4 * c * std::sin(half) + 2 * c * c * half;
    CHECK(integrate(thin, light, ray, 0, 100).r == Approx(unit * integral / ((1 - c) * (1 - c)) / 2).epsilon(1e-9));
  }
  SECTION("range") {
    const tyndall::Light light = pointAt({0, 3, 0}, 5);
    CHECK(integrate(thin, light, ray, 0, 100).r == Approx(unit * 2 * std::atan(4.0 / 3.0) / 3).epsilon(1e-9));
    CHECK(integrate(thin, pointAt({0, 3, 0}, 2), ray, 0, 100).r == 0);
  }
}
