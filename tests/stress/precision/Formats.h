// Texture formats that a quantity may be stored in, as roundings of numbers.
#pragma once

#include <array>
#include <string>

namespace precision {

enum class Format {
  Float32,
  Half,     ///< 1 sign, 5 exponent, 10 mantissa bits: R16F, RG16F, RGBA16F
  Unorm16,  ///< even steps, 65535 of them: R16, RG16, RGBA16
  Float24,  ///< 1 sign, 7 exponent, 16 mantissa bits; no format of GL's, but what 24 bits could hold
  Unorm24,  ///< even steps, 2^24 - 1 of them, as DEPTH_COMPONENT24
  Packed11, ///< no sign, 5 exponent, 6 mantissa bits: R11F_G11F_B10F, whose third channel has 5
  Count
};
const char* nameOf(Format format);

/// Where a number between two that the format holds goes.
enum class Direction { Nearest, Down, Up, ToZero };

/// The numbers that even steps go over.
struct Range {
  float least = 0, greatest = 1;
};

/// What a texel of that format gives back; `channel` 0 to 3. NaN stays. Of even steps what is outside the range is
/// clamped to it.
float rounded(float value, Format format, int channel, Direction direction, const Range& range);

} // namespace precision
