// FLIP against answers that its formulas give on paper, and against its properties.
#include "support/Catch.h"

#include <cmath>
#include <cstdint>
#include <regress/Flip.h>
#include <vector>

namespace {

constexpr int kSide = 48;

using Bytes = std::vector<std::uint8_t>;

Bytes flat(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Bytes bytes;
  for (int i = 0; i < kSide * kSide; ++i)
    bytes.insert(bytes.end(), {r, g, b});
  return bytes;
}

double meanFlip(const Bytes& wanted, const Bytes& got) {
  return regress::meanOf(regress::flip(wanted, got, kSide, kSide));
}

/// Black with a vertical white line at a column.
Bytes line(int column) {
  Bytes bytes = flat(0, 0, 0);
  for (int row = 0; row < kSide; ++row)
    for (int c = 0; c < 3; ++c)
      bytes[3 * (row * kSide + column) + c] = 255;
  return bytes;
}

} // namespace

TEST_CASE("FLIP of a picture and itself is zero everywhere") {
  Bytes noise;
  for (unsigned i = 0; i < 3U * kSide * kSide; ++i)
    noise.push_back(static_cast<std::uint8_t>(i * 2654435761U >> 24));
  for (const float value : regress::flip(noise, noise, kSide, kSide))
    CHECK(value == 0);
}

TEST_CASE("FLIP of flat colours is what its formula gives on paper") {
  // Without features and with filters of weight 1 only the colour's difference is left. Black and white are 100 apart
  // in lightness and nothing else; pure green and pure blue are the pair that the scale ends at.
  const double hyabGreenBlue = 203.4; // of CIELAB (87.7, -86.2, 83.2) and (32.3, 79.2, -107.9), a and b times L / 100
  const double largest = std::pow(hyabGreenBlue, 0.7), blackWhite = std::pow(100, 0.7);
  const double expected = 0.95 + (blackWhite - 0.4 * largest) / (0.6 * largest) * 0.05;
  CHECK(meanFlip(flat(0, 0, 0), flat(255, 255, 255)) == Approx(expected).margin(2e-4));
  CHECK(meanFlip(flat(0, 255, 0), flat(0, 0, 255)) == Approx(1).margin(1e-3)); // quantised by nothing but floats
  // Grey 119 and 128 differ by 3.6 in lightness: below the knee the scale is straight.
  const auto lightness = [](double s) { return 116 * std::cbrt(std::pow((s / 255 + 0.055) / 1.055, 2.4)) - 16; };
  const double grey = std::pow(lightness(128) - lightness(119), 0.7) / (0.4 * largest) * 0.95;
  CHECK(meanFlip(flat(119, 119, 119), flat(128, 128, 128)) == Approx(grey).margin(2e-4));
}

TEST_CASE("FLIP does not care which picture is the reference") {
  const Bytes a = line(20), b = line(27);
  CHECK(meanFlip(a, b) == Approx(meanFlip(b, a)));
  CHECK(meanFlip(a, b) > 0.01);
}

TEST_CASE("FLIP shows a moved line where it was and where it is, and nowhere far from it") {
  const std::vector<float> values = regress::flip(line(10), line(30), kSide, kSide);
  const auto at = [&](int column) { return values[kSide / 2 * kSide + column]; };
  CHECK(at(10) > 0.5);
  CHECK(at(30) > 0.5);
  CHECK(at(20) < 0.05);
  CHECK(at(46) < 0.05);
}

TEST_CASE("FLIP counts an edge by more than its colour") {
  // The same step of grey: of the whole picture, or of a line.
  const double flatStep = meanFlip(flat(0, 0, 0), flat(255, 255, 255));
  const std::vector<float> values = regress::flip(flat(0, 0, 0), line(24), kSide, kSide);
  const float onLine = values[kSide / 2 * kSide + 24];
  CHECK(onLine > 0.6 * flatStep);
  CHECK(onLine <= 1);
}
