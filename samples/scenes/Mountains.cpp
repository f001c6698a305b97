#include "Mountains.h"

#include "Noise.h"
#include "Random.h"
#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

constexpr int kCoarse = 151; ///< points a side before the refinements: 151, 301, 601
/// Relative uplift: a ridged range, less towards the border.
std::vector<double> upliftOf(const HeightField& field, const Range& range) {
  std::vector<double> uplift;
  const double last = field.size - 1;
  for (int y = 0; y < field.size; ++y)
    for (int x = 0; x < field.size; ++x) {
      const glm::dvec2 p(x / last, y / last);
      const glm::dvec2 bent =
          4.0 * p + 0.45 * glm::dvec2(fractal(3.0 * p, 3, range.seed + 11), fractal(3.0 * p, 3, range.seed + 23));
      const double edge = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
      const double rise = std::clamp(edge / 0.12, 0.0, 1.0);
      uplift.push_back(range.uplift * rise * (0.18 + 1.25 * ridged(bent, 4, range.seed + 31)));
    }
  return uplift;
}

} // namespace

HeightField mountains(const Range& range) {
  HeightField field;
  field.size = kCoarse;
  field.cell = range.side / (kCoarse - 1);
  for (int y = 0; y < kCoarse; ++y)
    for (int x = 0; x < kCoarse; ++x)
      field.heights.push_back(12 * (1 + fractal({0.11 * x, 0.11 * y}, 4, range.seed + 3)));
  Rivers rivers;
  rivers.creep = 0.04;
  erode(field, upliftOf(field, range), rivers, 90);
  field = refined(field);
  rivers.creep = 0.08;
  erode(field, upliftOf(field, range), rivers, 16);
  field = refined(field);
  rivers.creep = 0.15;
  erode(field, upliftOf(field, range), rivers, 5);
  for (int y = 0; y < field.size; ++y)
    for (int x = 0; x < field.size; ++x) {
      const double rough = std::clamp(field.at(x, y) / 1500, 0.1, 1.0);
      field.at(x, y) += range.detail * rough * (ridged({0.055 * x, 0.055 * y}, 5, range.seed + 71) - 0.4);
    }
  limitSlope(field, 1.3);
  return field;
}

glm::dvec3 Ground::point(int x, int y) const {
  const double half = 0.5 * field.cell * (field.size - 1);
  return {x * field.cell - half, field.at(x, y), y * field.cell - half};
}

glm::dvec3 Ground::normal(int x, int y) const {
  const int left = std::max(x - 1, 0);
  const int right = std::min(x + 1, field.size - 1);
  const int near = std::max(y - 1, 0);
  const int far = std::min(y + 1, field.size - 1);
  const double dx = (field.at(right, y) - field.at(left, y)) / ((right - left) * field.cell);
  const double dy = (field.at(x, far) - field.at(x, near)) / ((far - near) * field.cell);
  return glm::normalize(glm::dvec3(-dx, 1, -dy));
}

double Ground::height(const glm::dvec2& place) const {
  const double last = field.size - 1;
  const glm::dvec2 at = glm::clamp(place / field.cell + 0.5 * last, glm::dvec2(0), glm::dvec2(last - 1e-9));
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
  const glm::dvec2 f = at - glm::dvec2(x, y);
  const double near = glm::mix(field.at(x, y), field.at(x + 1, y), f.x);
  return glm::mix(near, glm::mix(field.at(x, y + 1), field.at(x + 1, y + 1), f.x), f.y);
}

void cover(MeshBuilder& mesh, const Ground& ground, int (*coverAt)(const glm::dvec3&, const glm::dvec3&, double),
           const std::vector<int>& materials) {
  const int n = ground.field.size;
  for (int kind = 0; kind < static_cast<int>(materials.size()); ++kind) {
    mesh.material(materials[static_cast<std::size_t>(kind)]);
    // The vertex of each grid point in this material, where it has one.
    std::vector<std::int64_t> shared(ground.field.heights.size(), -1);
    const auto vertex = [&](int x, int y) {
      std::int64_t& index =
          shared[static_cast<std::size_t>(y) * static_cast<std::size_t>(n) + static_cast<std::size_t>(x)];
      if (index < 0) index = mesh.vertex(ground.point(x, y), ground.normal(x, y));
      return static_cast<std::uint32_t>(index);
    };
    for (int y = 0; y + 1 < n; ++y)
      for (int x = 0; x + 1 < n; ++x) {
        const glm::dvec3 normal = ground.normal(x, y);
        const glm::dvec3 middle = 0.5 * (ground.point(x, y) + ground.point(x + 1, y + 1));
        const bool isLower = coverAt(middle, normal, hashOf(x, y, 0)) == kind;
        const bool isUpper = coverAt(middle, normal, hashOf(x, y, 1)) == kind;
        if (!isLower && !isUpper) continue;
        const std::uint32_t here = vertex(x, y);
        const std::uint32_t opposite = vertex(x + 1, y + 1);
        if (isLower) mesh.triangle(here, vertex(x, y + 1), opposite);
        if (isUpper) mesh.triangle(here, opposite, vertex(x + 1, y));
      }
  }
}

} // namespace scenes
