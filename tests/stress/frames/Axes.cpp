#include "Axes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

namespace stress {

namespace {

constexpr const char* kNames[] = {
    "size",     "viewport", "lens",     "pose",     "world",      "surface", "depth-form", "lights",    "places",
    "cones",    "views",    "map-size", "texels",   "odd-texels", "layout",  "filter",     "medium",    "far-distance",
    "radiance", "glass",    "settings", "relation", "layers",     "ambient", "look-up",    "eye-curves"};
static_assert(std::size(kNames) == kAxes);

// Steele et al. 2014, "Fast splittable pseudorandom number generators": the same on every machine.
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

} // namespace

const char* nameOf(Axis axis) { return kNames[static_cast<int>(axis)]; }

std::string AxisSet::text() const {
  std::string text;
  for (int i = 0; i < kAxes; ++i)
    if (has(static_cast<Axis>(i))) text += (text.empty() ? "" : ",") + std::string(kNames[i]);
  return text;
}

AxisSet AxisSet::parse(const std::string& text) {
  AxisSet set;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    int axis = 0;
    while (axis < kAxes && name != kNames[axis])
      ++axis;
    if (axis == kAxes) throw std::invalid_argument(name);
    set.add(static_cast<Axis>(axis));
    begin = end + 1;
  }
  return set;
}

Random::Random(std::uint64_t seed, Axis axis)
    : state_(mixed(seed * 0x9e3779b97f4a7c15U + static_cast<std::uint64_t>(axis) + 1)) {}

std::uint64_t Random::bits() { return mixed(state_ += 0x9e3779b97f4a7c15U); }

double Random::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
}

double Random::logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

int Random::integer(int low, int high) {
  return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
}

glm::dvec3 Random::direction() {
  const double z = uniform(-1, 1), angle = uniform(0, glm::two_pi<double>()), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

} // namespace stress
