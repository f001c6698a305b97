// What the references share: double-precision colours, rays and images.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace reference {

using Rgb = glm::dvec3; ///< one value per colour channel, linear

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points origin + s direction, s >= 0 in world units; the direction has unit length.
struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, -1};
  glm::dvec3 at(double s) const { return origin + s * direction; }
};

/// A stretch of a ray in world units; empty unless begin < end.
struct Interval {
  double begin = 0;
  double end = 0;
};

/// Linear RGB, three doubles a pixel, row 0 at the bottom.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<double> rgb;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Image(int w, int h, const std::vector<float>& values) : width(w), height(h), rgb(values.begin(), values.end()) {}
  std::size_t index(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  Rgb at(int x, int y) const { return {rgb[index(x, y)], rgb[index(x, y) + 1], rgb[index(x, y) + 2]}; }
  void set(int x, int y, const Rgb& value) {
    for (int c = 0; c < 3; ++c)
      rgb[index(x, y) + static_cast<std::size_t>(c)] = value[c];
  }
};

/// Whether all values are equal; a comparison that Metrics.h tells of.
bool operator==(const Image& image, const Image& reference);

/// What a reference says about a pixel, or about all of them.
struct PixelAnswer {
  Rgb inscatter{0};
  Rgb transmittance{1};
};
struct ImageAnswer {
  Image inscatter;
  Image transmittance;
};

inline glm::dvec3 toVec3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline Rgb toRgb(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

} // namespace reference
