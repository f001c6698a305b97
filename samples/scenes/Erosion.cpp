#include "Erosion.h"

#include "Noise.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

namespace scenes {
namespace {

struct Drainage {
  std::vector<int> order;    ///< points from the outlets up
  std::vector<int> receiver; ///< where a point's water goes; itself for an outlet
};

Drainage drain(const HeightField& field) {
  const int n = field.size;
  // A point's level, and its index so that equal levels have an order.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  Drainage drainage;
  drainage.receiver.assign(field.heights.size(), -1);
  for (int i = 0; i < n * n; ++i) {
    const int x = i % n;
    const int y = i / n;
    if (x > 0 && y > 0 && x < n - 1 && y < n - 1) continue;
    drainage.receiver[static_cast<std::size_t>(i)] = i;
    front.emplace(field.at(x, y), i);
  }
  while (!front.empty()) {
    const auto [level, point] = front.top();
    front.pop();
    drainage.order.push_back(point);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = point % n + dx;
        const int y = point / n + dy;
        if (x < 0 || y < 0 || x >= n || y >= n) continue;
        const int next = y * n + x;
        if (drainage.receiver[static_cast<std::size_t>(next)] >= 0) continue;
        drainage.receiver[static_cast<std::size_t>(next)] = point;
        front.emplace(std::max(level, field.at(x, y)), next);
      }
  }
  return drainage;
}

std::vector<double> catchments(const HeightField& field, const Drainage& drainage) {
  std::vector<double> area(field.heights.size(), field.cell * field.cell);
  for (auto i = drainage.order.rbegin(); i != drainage.order.rend(); ++i) {
    const int to = drainage.receiver[static_cast<std::size_t>(*i)];
    if (to != *i) area[static_cast<std::size_t>(to)] += area[static_cast<std::size_t>(*i)];
  }
  return area;
}

void cut(HeightField& field, const Drainage& drainage, const std::vector<double>& uplift, const Rivers& rivers) {
  const std::vector<double> area = catchments(field, drainage);
  const double diagonal = field.cell * std::sqrt(2.0);
  for (const int point : drainage.order) {
    const auto i = static_cast<std::size_t>(point);
    const auto to = static_cast<std::size_t>(drainage.receiver[i]);
    if (to == i) continue;
    const int x = point % field.size;
    const int y = point / field.size;
    const int across = x - static_cast<int>(to) % field.size;
    const int along = y - static_cast<int>(to) / field.size;
    const double length = across != 0 && along != 0 ? diagonal : field.cell;
    const double flow = area[i] / std::sqrt(area[i] + rivers.source);
    const double strength = rivers.erodibility * flow / length;
    const glm::dvec2 place(x * field.cell, y * field.cell);
    const double firmness = 1 + 0.5 * fractal(place / 900.0, 3, 57);
    const double height = (field.heights[i] + uplift[i] + strength * field.heights[to]) / (1 + strength);
    field.heights[i] = std::clamp(height, field.heights[to], field.heights[to] + rivers.talus * firmness * length);
  }
}

void creep(HeightField& field, double part) {
  const HeightField before = field;
  for (int y = 1; y + 1 < field.size; ++y)
    for (int x = 1; x + 1 < field.size; ++x) {
      const double mean =
          0.25 * (before.at(x - 1, y) + before.at(x + 1, y) + before.at(x, y - 1) + before.at(x, y + 1));
      field.at(x, y) += part * (mean - before.at(x, y));
    }
}

} // namespace

void erode(HeightField& field, const std::vector<double>& uplift, const Rivers& rivers, int steps) {
  for (int step = 0; step < steps; ++step) {
    cut(field, drain(field), uplift, rivers);
    creep(field, rivers.creep);
  }
}

void limitSlope(HeightField& field, double slope) {
  const int n = field.size;
  // Rubble comes down from one point to the next, so the lowest must be settled first.
  std::vector<int> order(field.heights.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const double ha = field.heights[static_cast<std::size_t>(a)];
    const double hb = field.heights[static_cast<std::size_t>(b)];
    return ha != hb ? ha < hb : a < b;
  });
  for (const int point : order)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = point % n + dx;
        const int y = point / n + dy;
        if (x < 0 || y < 0 || x >= n || y >= n) continue;
        const double reach = slope * field.cell * std::sqrt(static_cast<double>(dx * dx + dy * dy));
        double& height = field.at(point % n, point / n);
        height = std::min(height, field.at(x, y) + reach);
      }
}

HeightField refined(const HeightField& field) {
  HeightField fine;
  fine.size = 2 * field.size - 1;
  fine.cell = 0.5 * field.cell;
  fine.heights.resize(static_cast<std::size_t>(fine.size) * static_cast<std::size_t>(fine.size));
  for (int y = 0; y < fine.size; ++y)
    for (int x = 0; x < fine.size; ++x)
      fine.at(x, y) = 0.25 * (field.at(x / 2, y / 2) + field.at((x + 1) / 2, y / 2) + field.at(x / 2, (y + 1) / 2) +
                              field.at((x + 1) / 2, (y + 1) / 2));
  return fine;
}

} // namespace scenes
