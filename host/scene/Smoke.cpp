#include "scene/Smoke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace host {

namespace {

constexpr double kFadeIn = 0.08;  ///< share of a life in which a particle appears
constexpr double kFadeOut = 0.45; ///< and from which on it vanishes
constexpr int kBirthplaces = 48;  ///< of a moving node, evenly over a life; between them it goes straight

/// In [0, 1), from a lattice point (a, b) and a seed: two rounds of a multiply-and-shift mix.
double hashOf(int seed, int a, int b) {
  std::uint32_t h = static_cast<std::uint32_t>(seed) * 0x9e3779b9U + static_cast<std::uint32_t>(a) * 0x85ebca6bU +
                    static_cast<std::uint32_t>(b) * 0xc2b2ae35U;
  for (int round = 0; round < 2; ++round) {
    h ^= h >> 16U;
    h *= 0x7feb352dU;
    h ^= h >> 15U;
    h *= 0x846ca68bU;
  }
  h ^= h >> 16U;
  return h * (1.0 / 4294967296.0);
}

glm::dvec3 directionOf(double u, double v) {
  const double z = 2 * u - 1;
  const double around = std::sqrt(std::max(0.0, 1 - z * z));
  const double angle = glm::two_pi<double>() * v;
  return {around * std::cos(angle), around * std::sin(angle), z};
}

/// A plane wave of displacement across its own direction, as eddies are without divergence.
struct Eddy {
  glm::dvec3 wave{0}; ///< radians per world unit
  glm::dvec3 reach{0};
  double turns = 0; ///< radians per second
  double phase = 0;
};

/// Two eddies of each of three sizes. Together they carry no farther than the emitter's turbulence; each turns a whole
/// number of times in a life, so that the smoke repeats.
std::array<Eddy, 6> eddiesOf(const SmokeEmitter& emitter) {
  constexpr double kShares[] = {0.50, 0.30, 0.20};
  constexpr double kLengths[] = {0.8, 0.36, 0.16}; ///< of the emitter's height
  std::array<Eddy, 6> eddies;
  for (int i = 0; i < 6; ++i) {
    const int size = i / 2;
    const auto draw = [&](int what) { return hashOf(emitter.seed, -1 - i, what); };
    const glm::dvec3 along = directionOf(draw(0), draw(1));
    const glm::dvec3 other = directionOf(draw(2), draw(3));
    glm::dvec3 across = glm::cross(along, other);
    const double length = glm::length(across);
    across = length > 1e-6 ? across / length : glm::dvec3(0); // 1e-6: two equal directions make no eddy
    Eddy& eddy = eddies[static_cast<std::size_t>(i)];
    eddy.wave = glm::two_pi<double>() / (kLengths[size] * emitter.height) * along;
    eddy.reach = 0.5 * kShares[size] * emitter.turbulence * across;
    eddy.turns = glm::two_pi<double>() * (size + 1) / emitter.lifetime();
    eddy.phase = glm::two_pi<double>() * draw(4);
  }
  return eddies;
}

double smoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Where the emitter was at even steps back over a life: now first. One place if nothing in the scene moves.
std::vector<glm::dvec3> birthplaces(const Scene& scene, const SmokeEmitter& emitter, double seconds) {
  const int count = scene.animation.empty() ? 1 : kBirthplaces + 1;
  std::vector<glm::dvec3> places;
  for (int i = 0; i < count; ++i) {
    const double time = seconds - emitter.lifetime() * i / kBirthplaces;
    places.emplace_back(poseAt(scene, time)[static_cast<std::size_t>(emitter.node)][3]);
  }
  return places;
}

glm::dvec3 birthplace(const std::vector<glm::dvec3>& places, double age) {
  const double at = age * static_cast<double>(places.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), places.size() - 1);
  return glm::mix(places[i], places[std::min(i + 1, places.size() - 1)], at - static_cast<double>(i));
}

SmokeParticle particleOf(const SmokeEmitter& emitter, const std::array<Eddy, 6>& eddies,
                         const std::vector<glm::dvec3>& places, int index, double seconds) {
  const double jitter = hashOf(emitter.seed, index, 0);
  const double lives = seconds / emitter.lifetime() + (index + jitter) / emitter.particles;
  const double age = lives - std::floor(lives);
  const double grown = 1 + (emitter.growth - 1) * age;
  const double out = emitter.spread * grown * std::sqrt(hashOf(emitter.seed, index, 1));
  const double angle = glm::two_pi<double>() * hashOf(emitter.seed, index, 2);
  const glm::dvec3 path = glm::dvec3(out * std::cos(angle), emitter.height * age, out * std::sin(angle)) +
                          age * emitter.lifetime() * emitter.drift;
  glm::dvec3 carried(0);
  for (const Eddy& eddy : eddies)
    carried += std::sin(glm::dot(eddy.wave, path) - eddy.turns * seconds + eddy.phase) * eddy.reach;
  SmokeParticle particle;
  particle.position = birthplace(places, age) + path + age * carried;
  particle.radius = emitter.radius * grown * (0.65 + 0.35 * hashOf(emitter.seed, index, 3));
  particle.density = emitter.density * emitter.radius / particle.radius * smoothStep(0, kFadeIn, age) *
                     (1 - smoothStep(kFadeOut, 1, age));
  particle.albedo = emitter.albedo;
  return particle;
}

} // namespace

std::vector<SmokeParticle> smokeAt(const Scene& scene, double seconds) {
  std::vector<SmokeParticle> particles;
  for (const SmokeEmitter& emitter : scene.smoke) {
    const std::array<Eddy, 6> eddies = eddiesOf(emitter);
    const std::vector<glm::dvec3> places = birthplaces(scene, emitter, seconds);
    for (int i = 0; i < emitter.particles; ++i)
      particles.push_back(particleOf(emitter, eddies, places, i, seconds));
  }
  return particles;
}

Bounds smokeBounds(const Scene& scene, const SmokeEmitter& emitter, double seconds) {
  const std::vector<glm::dvec3> places = birthplaces(scene, emitter, seconds);
  Bounds bounds{places.front(), places.front()};
  for (const glm::dvec3& place : places) {
    bounds.low = glm::min(bounds.low, place);
    bounds.high = glm::max(bounds.high, place);
  }
  const double grown = std::max(1.0, emitter.growth);
  const double aside = emitter.turbulence + grown * emitter.radius;
  const glm::dvec3 reach(aside + grown * emitter.spread, aside, aside + grown * emitter.spread);
  const glm::dvec3 path = emitter.lifetime() * emitter.drift + glm::dvec3(0, emitter.height, 0);
  bounds.low += glm::min(path, glm::dvec3(0)) - reach;
  bounds.high += glm::max(path, glm::dvec3(0)) + reach;
  return bounds;
}

} // namespace host
