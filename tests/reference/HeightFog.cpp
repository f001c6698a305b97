#include "HeightFog.h"

#include "Optics.h"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

constexpr double kUnderflow = 746; // exp(-x) is 0 in double precision beyond this
constexpr double kDensest = -60;   // the least exponent that tyndall.h allows

struct Exponents {
  double from, to, ground;
};

// Of a way of so much from a point on: the difference of two points of it could be lost in the digits of a large world.
Exponents exponentsOf(const tyndall::Medium& medium, std::size_t layer, const glm::dvec3& from, const glm::dvec3& way) {
  const tyndall::HeightLayer& of = medium.layers[layer];
  if (!std::isfinite(of.scale)) return {0, 0, kDensest};
  const glm::dvec3 up = glm::normalize(toVec3(medium.up));
  const double begin = (glm::dot(up, from) - of.height) / of.scale;
  return {begin, begin + glm::dot(up, way) / of.scale, std::max(kDensest, (of.ground - of.height) / of.scale)};
}

// Mean of exp(-max(e, ground)) over e between two exponents.
double meanDensity(const Exponents& e) {
  const double low = std::min(e.from, e.to), high = std::max(e.from, e.to);
  const auto above = [](double a, double b) { // integral of exp(-e) from a to b
    return std::exp(-a) * -std::expm1(a - b);
  };
  if (high - low == 0) return std::exp(-std::max(low, e.ground));
  if (high <= e.ground) return std::exp(-e.ground);
  if (low >= e.ground) return above(low, high) / (high - low);
  return (std::exp(-e.ground) * (e.ground - low) + above(e.ground, high)) / (high - low);
}

// Sum over what follows a layer, or none (-1).
Rgb extinctionOf(const tyndall::Medium& medium, int layer) {
  Rgb sum = medium.absorptionLayer == layer ? toRgb(medium.absorption) : Rgb(0);
  for (const tyndall::Constituent& c : medium.constituents)
    if (c.layer == layer) sum += toRgb(c.scattering);
  return sum;
}

double greatest(const Rgb& v) { return std::max({v.r, v.g, v.b}); }

} // namespace

bool isLayered(const tyndall::Medium& medium) {
  for (int i = 0; i < static_cast<int>(medium.layers.size()); ++i)
    if (extinctionOf(medium, i) != Rgb(0)) return true;
  return false;
}

Rgb opticalDepth(const tyndall::Medium& medium, const glm::dvec3& from, const glm::dvec3& way) {
  const double length = glm::length(way);
  Rgb sum = extinctionOf(medium, -1) * length;
  for (std::size_t i = 0; i < medium.layers.size(); ++i) {
    const Rgb sigma = extinctionOf(medium, static_cast<int>(i));
    if (sigma != Rgb(0)) sum += sigma * (length * meanDensity(exponentsOf(medium, i, from, way)));
  }
  return sum;
}

HeightFog::HeightFog(const tyndall::Medium& medium, const tyndall::Light& light, const Ray& ray)
    : medium_(medium), light_(light), ray_(ray) {
  for (std::size_t i = 0; i < medium.layers.size(); ++i)
    if (std::isfinite(medium.layers[i].scale) && extinctionOf(medium, static_cast<int>(i)) != Rgb(0)) addBreaks(i);
  std::sort(breaks_.begin(), breaks_.end());
  constexpr double kEndless = 1e30;
  for (end_ = 1e-9; end_ < kEndless && !isNothingBehind(end_);)
    end_ *= 2;
}

double HeightFog::exponent(std::size_t layer, const glm::dvec3& x) const {
  const Exponents e = exponentsOf(medium_, layer, x, glm::dvec3(0));
  return std::max(e.from, e.ground);
}

Rgb HeightFog::eyeDepth(double s) const { return opticalDepth(medium_, ray_.origin, s * ray_.direction); }

Rgb HeightFog::depth(double s) const {
  const glm::dvec3 x = ray_.at(s);
  Rgb sum = eyeDepth(s);
  if (light_.kind != tyndall::LightKind::Directional) {
    const glm::dvec3 lamp = toVec3(light_.position);
    return sum + opticalDepth(medium_, lamp, x - lamp);
  }
  if (!light_.boundary.enabled) return sum;
  const glm::dvec3 travel = glm::normalize(toVec3(light_.direction)), normal = toVec3(light_.boundary.normal);
  const double way = glm::dot(x - toVec3(light_.boundary.point), normal) / glm::dot(travel, normal);
  if (way > 0) sum += opticalDepth(medium_, x, -way * travel);
  return sum;
}

Rgb HeightFog::scattering(double s, double cosTheta) const {
  std::vector<Rgb> phases;
  for (const tyndall::Constituent& c : medium_.constituents)
    phases.emplace_back(phase(c.phase, c.g, cosTheta));
  return scattering(s, phases);
}

Rgb HeightFog::scattering(double s, const std::vector<Rgb>& factors) const {
  Rgb sum(0);
  for (std::size_t k = 0; k < medium_.constituents.size(); ++k) {
    const tyndall::Constituent& c = medium_.constituents[k];
    const double density = c.layer < 0 ? 1 : std::exp(-exponent(static_cast<std::size_t>(c.layer), ray_.at(s)));
    sum += toRgb(c.scattering) * density * factors[k];
  }
  return sum;
}

Rgb HeightFog::extinction(double s) const {
  Rgb sum = extinctionOf(medium_, -1);
  for (std::size_t i = 0; i < medium_.layers.size(); ++i)
    sum += extinctionOf(medium_, static_cast<int>(i)) * std::exp(-exponent(i, ray_.at(s)));
  return sum;
}

double HeightFog::rate(double s) const {
  double sum = 0;
  for (std::size_t i = 0; i < medium_.layers.size(); ++i) {
    const Exponents e = exponentsOf(medium_, i, glm::dvec3(0), ray_.direction);
    sum += std::abs(e.to - e.from);
  }
  const double step = 1e-3 / (sum + greatest(extinction(s)) + 1e-300);
  return sum + greatest(extinction(s)) + greatest(glm::abs(depth(s + step) - depth(s))) / step;
}

// Seen are densities from where the ray comes through less than 1000 optical depths down to e^-50 of that of one; of a
// lamp's or sun's own way a thousand times as long.
void HeightFog::addBreaks(std::size_t layer) {
  const Exponents e = exponentsOf(medium_, layer, ray_.origin, ray_.direction);
  const double slope = e.to - e.from;
  if (slope == 0) return;
  breaks_.push_back((e.ground - e.from) / slope);
  const Rgb sigma = extinctionOf(medium_, static_cast<int>(layer));
  double least = tyndall::kInfinity;
  for (int c = 0; c < 3; ++c)
    if (sigma[c] > 0) least = std::min(least, sigma[c]);
  double low = std::max(e.ground, std::log(least / std::abs(slope)) - 8);
  double high = std::log(greatest(sigma) / std::abs(slope)) + 57;
  if (slope > 0) { // densest at the eye
    low = std::max(low, e.from);
    high = std::max(high, low + 57);
  }
  for (double at = low; at < high; at += 2)
    if (const double s = (at - e.from) / slope; s > 0) breaks_.push_back(s);
}

bool HeightFog::isNothingBehind(double s) const {
  const Rgb passed = eyeDepth(s);
  for (const tyndall::Constituent& c : medium_.constituents) {
    if (c.layer >= 0) {
      const auto layer = static_cast<std::size_t>(c.layer);
      const bool thins = exponent(layer, ray_.at(2 * s)) > exponent(layer, ray_.at(s));
      if (thins && exponent(layer, ray_.at(s)) > kUnderflow) continue;
    }
    for (int i = 0; i < 3; ++i)
      if (c.scattering[static_cast<std::size_t>(i)] > 0 && passed[i] < kUnderflow) return false;
  }
  return true;
}

} // namespace reference
