#include "Ground.h"

#include "Random.h"
#include <algorithm>

namespace scenes {

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

void cover(MeshBuilder& mesh, const Ground& ground, CoverAt coverAt, const std::vector<int>& materials) {
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

void paint(MeshBuilder& mesh, const Ground& ground, ColourAt colourAt) {
  const int n = ground.field.size;
  std::vector<std::uint32_t> row, last;
  for (int y = 0; y < n; ++y) {
    last.swap(row);
    row.clear();
    for (int x = 0; x < n; ++x) {
      const glm::dvec3 point = ground.point(x, y), normal = ground.normal(x, y);
      row.push_back(mesh.vertex(point, normal, colourAt(point, normal)));
    }
    for (std::size_t x = 0; y > 0 && x + 1 < row.size(); ++x) {
      mesh.triangle(last[x], row[x], row[x + 1]);
      mesh.triangle(last[x], row[x + 1], last[x + 1]);
    }
  }
}

} // namespace scenes
