#include "Formats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace precision {

namespace {

double toWhole(double value, Direction direction) {
  if (direction == Direction::Down) return std::floor(value);
  if (direction == Direction::ToZero) return std::trunc(value);
  return direction == Direction::Up ? std::ceil(value) : std::nearbyint(value);
}

struct FloatForm {
  int mantissaBits = 0;
  int leastExponent = 0; ///< of a normal number; smaller ones have its steps
  double greatest = 0;   ///< more is infinite
};

float toFloatForm(double value, const FloatForm& form, Direction direction) {
  if (value == 0 || std::isinf(value)) return static_cast<float>(value);
  const int exponent = std::max(std::ilogb(value), form.leastExponent);
  const double step = std::ldexp(1.0, exponent - form.mantissaBits);
  const double result = step * toWhole(value / step, direction);
  if (std::abs(result) <= form.greatest) return static_cast<float>(result);
  return std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(value));
}

// Formats of unsigned small floats hold no infinity that a colour should become: GL gives the greatest number.
float toPacked(double value, int channel, Direction direction) {
  const int bits = channel == 2 ? 5 : 6;
  const double greatest = std::ldexp(2.0 - std::ldexp(1.0, -bits), 15);
  return toFloatForm(std::clamp(value, 0.0, greatest), {bits, -14, greatest}, direction);
}

// What is a whole number of steps but for the rounding of floats stays that, whatever the direction.
float toSteps(double value, double steps, Direction direction, const Range& range) {
  constexpr double kRounding = 2e-7;
  const double least = range.least, size = range.greatest - least;
  if (!(size > 0)) return range.least;
  const double scaled = std::clamp((value - least) / size, 0.0, 1.0) * steps, whole = std::nearbyint(scaled);
  const bool isWhole = std::abs(scaled - whole) <= kRounding * (scaled + steps * std::abs(least) / size);
  return static_cast<float>(least + size * ((isWhole ? whole : toWhole(scaled, direction)) / steps));
}

} // namespace

const char* nameOf(Format format) {
  constexpr std::array<const char*, static_cast<std::size_t>(Format::Count)> kNames = {
      "float 32", "half 16", "unorm 16", "float 24", "unorm 24", "11-11-10"};
  return kNames[static_cast<std::size_t>(format)];
}

float rounded(float value, Format format, int channel, Direction direction, const Range& range) {
  if (std::isnan(value)) return value;
  switch (format) {
  case Format::Half:
    return toFloatForm(value, {10, -14, 65504}, direction);
  case Format::Float24:
    return toFloatForm(value, {16, -62, std::ldexp(2.0 - std::ldexp(1.0, -16), 63)}, direction);
  case Format::Packed11:
    return toPacked(value, channel, direction);
  case Format::Unorm16:
    return toSteps(value, 65535, direction, range);
  case Format::Unorm24:
    return toSteps(value, 16777215, direction, range);
  default:
    return value;
  }
}

} // namespace precision
