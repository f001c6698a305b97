#include "Ambient.h"

#include "Optics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace reference {
namespace {

constexpr double kPi = glm::pi<double>();

} // namespace

bool isLit(const tyndall::Ambient& ambient) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    sum += std::abs(double(ambient.radiance[c]));
    for (const tyndall::Rgb& harmonic : ambient.harmonics)
      sum += std::abs(double(harmonic[c]));
  }
  return sum > 0;
}

Rgb radianceFrom(const tyndall::Ambient& ambient, const glm::dvec3& side) {
  const double x = side.x, y = side.y, z = side.z, a = std::sqrt(1 / (4 * kPi)), b = std::sqrt(3 / (4 * kPi)),
               c = std::sqrt(15 / (4 * kPi));
  const std::array<double, 9> harmonics = {a,
                                           b * y,
                                           b * z,
                                           b * x,
                                           c * x * y,
                                           c * y * z,
                                           std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1),
                                           c * x * z,
                                           0.5 * c * (x * x - y * y)};
  Rgb sum = toRgb(ambient.radiance);
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    sum += harmonics[i] * toRgb(ambient.harmonics[i]);
  return sum;
}

// Around the ray six sides at each angle are enough for harmonics of degree 2. A phase function's peak is as wide as
// 1 - |g|.
Rgb scatteredRadiance(const tyndall::Constituent& constituent, const tyndall::Ambient& ambient,
                      const glm::dvec3& direction) {
  constexpr int kAround = 6;
  const glm::dvec3 other = std::abs(direction.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(direction, other)), v = glm::cross(direction, u);
  const auto ring = [&](double angle) {
    Rgb sum(0);
    for (int i = 0; i < kAround; ++i) {
      const double turn = 2 * kPi * i / kAround;
      const glm::dvec3 side = std::cos(angle) * direction + std::sin(angle) * (std::cos(turn) * u + std::sin(turn) * v);
      sum += radianceFrom(ambient, side) * (2 * kPi / kAround);
    }
    // Light from that side travels against it, and to the eye against the ray.
    return sum * (std::sin(angle) * phase(constituent.phase, constituent.g, std::cos(angle)));
  };
  const double peak = 1 - std::abs(constituent.g);
  std::vector<double> ends = {0, kPi};
  for (double end = 0.5 * peak; end < 0.5 * kPi; end *= 2) {
    ends.push_back(end);
    ends.push_back(kPi - end);
  }
  std::sort(ends.begin(), ends.end());
  Rgb bright(1e-300), sum(0); // harmonics may be negative: what is added to them is what a relative error is of
  for (int i = 0; i < 3; ++i)
    for (const tyndall::Rgb& c : ambient.harmonics)
      bright[i] += std::abs(double(c[static_cast<std::size_t>(i)]));
  bright += toRgb(ambient.radiance);
  Rgb all = bright;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    addAdaptive(ring, ends[i], ends[i + 1], all);
  sum = all - bright;
  return sum;
}

Airlight ambientAirlight(const tyndall::Medium& medium, const tyndall::Ambient& ambient, const Ray& ray) {
  std::vector<Rgb> radiances;
  for (const tyndall::Constituent& constituent : medium.constituents)
    radiances.push_back(scatteredRadiance(constituent, ambient, ray.direction));
  for (int layer = -1; layer < static_cast<int>(medium.layers.size()); ++layer) {
    Rgb together(0);
    for (std::size_t k = 0; k < radiances.size(); ++k)
      if (!isLayered(medium) || medium.constituents[k].layer == layer)
        together += toRgb(medium.constituents[k].scattering) * radiances[k];
    for (std::size_t k = 0; k < radiances.size(); ++k)
      for (int c = 0; c < 3; ++c)
        if (together[c] < 0 && (!isLayered(medium) || medium.constituents[k].layer == layer)) radiances[k][c] = 0;
  }
  return {medium, radiances, ray};
}

Rgb ambientLight(const tyndall::Medium& medium, const tyndall::Ambient& ambient, const Ray& ray, double end) {
  return ambientAirlight(medium, ambient, ray).span(0, end);
}

double openShare(const Occlusion& occlusion, double x, double y) {
  if (occlusion.width == 0) return 1;
  const auto texel = [&](int i, int j) {
    const int column = std::clamp(i, 0, occlusion.width - 1), row = std::clamp(j, 0, occlusion.height - 1);
    const auto share = double(occlusion.shares[static_cast<std::size_t>(row * occlusion.width + column)]);
    return std::isnan(share) ? 1 : std::clamp(share, 0.0, 1.0);
  };
  const double u = x * occlusion.width - 0.5, v = y * occlusion.height - 0.5;
  const auto i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  const double f = u - i, g = v - j;
  return (1 - g) * ((1 - f) * texel(i, j) + f * texel(i + 1, j)) +
         g * ((1 - f) * texel(i, j + 1) + f * texel(i + 1, j + 1));
}

} // namespace reference
