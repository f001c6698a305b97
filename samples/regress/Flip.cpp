#include "Flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numeric>

namespace regress {

namespace {

constexpr double kPi = 3.14159265358979323846;

using Colours = std::vector<glm::vec3>;

struct Size {
  int width;
  int height;
};

// ---------------------------------------------------------------------------------------------------------------------
// Colour spaces. glm's matrices are written column by column.

const glm::dmat3 kXyzFromRgb(10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382, //
                             8788810.0 / 24577794, 8788810.0 / 12288897, 8788810.0 / 73733382,  //
                             4435075.0 / 24577794, 887015.0 / 12288897, 70074185.0 / 73733382);
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1);

double linearOf(std::uint8_t byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// Opponent colours, linear in radiance: lightness, red against green, blue against yellow.
glm::dvec3 opponentOf(const glm::dvec3& rgb) {
  const glm::dvec3 t = kXyzFromRgb * rgb / kWhite;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

glm::dvec3 rgbOfOpponent(const glm::dvec3& c) {
  const double y = (c.x + 16) / 116;
  return kRgbFromXyz * (glm::dvec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

/// CIELAB whose a and b shrink with the lightness, as Hunt found that colours do.
glm::dvec3 huntLabOf(const glm::dvec3& rgb) {
  const glm::dvec3 t = kXyzFromRgb * rgb / kWhite;
  const auto f = [](double v) {
    constexpr double kDelta = 6.0 / 29;
    return v > kDelta * kDelta * kDelta ? std::cbrt(v) : v / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double lightness = 116 * f(t.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(t.x) - f(t.y)), 0.01 * lightness * 200 * (f(t.y) - f(t.z))};
}

/// HyAB: city-block between lightness and colour, Euclidean within colour.
double hyab(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Colours opponentPicture(const std::vector<std::uint8_t>& bytes) {
  static const std::array<double, 256> linear = [] {
    std::array<double, 256> table{};
    for (int i = 0; i < 256; ++i)
      table[i] = linearOf(static_cast<std::uint8_t>(i));
    return table;
  }();
  Colours colours;
  colours.reserve(bytes.size() / 3);
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3)
    colours.emplace_back(opponentOf({linear[bytes[i]], linear[bytes[i + 1]], linear[bytes[i + 2]]}));
  return colours;
}

// ---------------------------------------------------------------------------------------------------------------------
// Filters. Each is separable; a border's pixels go on outside.

/// Weights of -radius to radius.
using Kernel = std::vector<double>;

template <typename Weight>
Kernel makeKernel(int radius, const Weight& weight) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x)
    kernel.push_back(weight(static_cast<double>(x)));
  return kernel;
}

double sumOf(const Kernel& kernel) { return std::accumulate(kernel.begin(), kernel.end(), 0.0); }

/// The plane convolved with a kernel along each axis.
std::vector<float> filtered(const std::vector<float>& plane, Size size, const Kernel& alongX, const Kernel& alongY) {
  const auto along = [&](const std::vector<float>& source, const Kernel& kernel, int dx, int dy) {
    const int radius = static_cast<int>(kernel.size() / 2);
    std::vector<float> result(source.size());
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) {
          const int column = std::clamp(x + i * dx, 0, size.width - 1),
                    row = std::clamp(y + i * dy, 0, size.height - 1);
          sum += kernel[i + radius] * source[static_cast<std::size_t>(row) * size.width + column];
        }
        result[static_cast<std::size_t>(y) * size.width + x] = static_cast<float>(sum);
      }
    return result;
  };
  return along(along(plane, alongX, 1, 0), alongY, 0, 1);
}

std::vector<float> planeOf(const Colours& colours, int channel) {
  std::vector<float> plane(colours.size());
  std::transform(colours.begin(), colours.end(), plane.begin(), [&](const glm::vec3& c) { return c[channel]; });
  return plane;
}

// ---------------------------------------------------------------------------------------------------------------------
// The colour's pipeline

/// Contrast sensitivity of an opponent channel: two Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees (table
/// 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
constexpr double kWidestB = 0.04;

/// What the eye makes out of a channel: the sum of the two, of weight 1 together.
std::vector<float> seen(const std::vector<float>& plane, Size size, const Sensitivity& s, double pixelsPerDegree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * pixelsPerDegree));
  const auto gaussian = [&](double b) {
    return makeKernel(radius,
                      [&](double x) { return std::exp(-kPi * kPi * x * x / (pixelsPerDegree * pixelsPerDegree * b)); });
  };
  const Kernel first = gaussian(s.b1), second = gaussian(s.b2);
  const double weight1 = s.a1 * kPi / s.b1, weight2 = s.a2 * kPi / s.b2;
  const double total = weight1 * sumOf(first) * sumOf(first) + weight2 * sumOf(second) * sumOf(second);
  std::vector<float> result = filtered(plane, size, first, first);
  for (float& value : result)
    value *= static_cast<float>(weight1 / total);
  if (weight2 == 0) return result;
  const std::vector<float> more = filtered(plane, size, second, second);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] += static_cast<float>(weight2 / total) * more[i];
  return result;
}

std::vector<glm::dvec3> seenColours(const Colours& opponent, Size size, double pixelsPerDegree) {
  std::vector<float> planes[3];
  for (int channel = 0; channel < 3; ++channel)
    planes[channel] = seen(planeOf(opponent, channel), size, kSensitivities[channel], pixelsPerDegree);
  std::vector<glm::dvec3> colours(opponent.size());
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours[i] = huntLabOf(glm::clamp(rgbOfOpponent({planes[0][i], planes[1][i], planes[2][i]}), 0.0, 1.0));
  return colours;
}

/// 0 to 1, by the largest difference that there is, of green and blue; most of it is for the smaller ones.
double colourDifference(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double kPower = 0.7, kKneeAt = 0.4, kKneeIs = 0.95;
  static const double largest = std::pow(hyab(huntLabOf({0, 1, 0}), huntLabOf({0, 0, 1})), kPower);
  const double difference = std::pow(hyab(a, b), kPower), knee = kKneeAt * largest;
  return difference < knee ? kKneeIs / knee * difference
                           : kKneeIs + (difference - knee) / (largest - knee) * (1 - kKneeIs);
}

// ---------------------------------------------------------------------------------------------------------------------
// The features' pipeline

/// The positive weights add up to 1, the negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double weight : kernel)
    (weight > 0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel)
    weight /= weight > 0 ? positive : negative;
  return kernel;
}

struct Features {
  std::vector<float> edges, points;
};

/// How much of an edge, and of a point or line, each pixel is: the lightness against derivatives of a Gaussian.
Features featuresOf(const Colours& opponent, Size size, double pixelsPerDegree) {
  constexpr double kWidth = 0.082; // degrees
  const double deviation = 0.5 * kWidth * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  Kernel smooth = makeKernel(radius, gaussian);
  const double sum = sumOf(smooth);
  for (double& weight : smooth)
    weight /= sum;
  const Kernel edge = balanced(makeKernel(radius, [&](double x) { return -x * gaussian(x); }));
  const Kernel point =
      balanced(makeKernel(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gaussian(x); }));
  std::vector<float> lightness = planeOf(opponent, 0);
  for (float& value : lightness)
    value = (value + 16) / 116;
  const auto length = [&](const Kernel& kernel) {
    std::vector<float> x = filtered(lightness, size, kernel, smooth);
    const std::vector<float> y = filtered(lightness, size, smooth, kernel);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  return {length(edge), length(point)};
}

} // namespace

std::vector<float> flip(const std::vector<std::uint8_t>& wanted, const std::vector<std::uint8_t>& got, int width,
                        int height, double pixelsPerDegree) {
  const Size size{width, height};
  const Colours opponents[] = {opponentPicture(wanted), opponentPicture(got)};
  const std::vector<glm::dvec3> colours[] = {seenColours(opponents[0], size, pixelsPerDegree),
                                             seenColours(opponents[1], size, pixelsPerDegree)};
  const Features features[] = {featuresOf(opponents[0], size, pixelsPerDegree),
                               featuresOf(opponents[1], size, pixelsPerDegree)};
  std::vector<float> result(colours[0].size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double feature = std::max(std::abs(features[0].edges[i] - features[1].edges[i]),
                                    std::abs(features[0].points[i] - features[1].points[i]));
    const double featureDifference = std::sqrt(feature / std::sqrt(2.0));
    result[i] = static_cast<float>(std::pow(colourDifference(colours[0][i], colours[1][i]), 1 - featureDifference));
  }
  return result;
}

double meanOf(const std::vector<float>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace regress
