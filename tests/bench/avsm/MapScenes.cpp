#include "MapScenes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <scene/Error.h>

namespace avsmbench {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Numbers in [0, 1) that do not depend on the C++ library.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  double bell() { return ((*this)() + (*this)() + (*this)() - 1.5) / 1.5; } ///< -1 to 1, most near 0

private:
  std::mt19937 engine_;
};

struct Puff {
  double x, y, depth; ///< centre in the map's place and depth, 0 to 1
  double radius;
  double density; ///< optical depth through the centre
};

/// A ball whose density falls to nothing at its outline. `flatness`: depth of a length across.
void draw(const Puff& puff, double flatness, MapScene& scene) {
  const auto texels = [&](double place) { return static_cast<int>(std::floor(place * scene.size)); };
  for (int y = std::max(texels(puff.y - puff.radius), 0); y <= std::min(texels(puff.y + puff.radius), scene.size - 1);
       ++y)
    for (int x = std::max(texels(puff.x - puff.radius), 0); x <= std::min(texels(puff.x + puff.radius), scene.size - 1);
         ++x) {
      const double dx = (x + 0.5) / scene.size - puff.x, dy = (y + 0.5) / scene.size - puff.y;
      const double inside = 1 - (dx * dx + dy * dy) / (puff.radius * puff.radius);
      if (inside <= 0) continue;
      const double half = std::sqrt(inside) * puff.radius * flatness;
      scene.segments.push_back({static_cast<std::uint32_t>(y * scene.size + x), static_cast<float>(puff.depth - half),
                                static_cast<float>(puff.depth + half),
                                static_cast<float>(std::exp(-puff.density * std::pow(inside, 1.5)))});
    }
}

/// Three columns, each swaying and widening as it rises, made of billows, which small tight and large thin puffs make
/// up; in the middle of the map all three stand behind each other.
void drawSmoke(MapScene& scene) {
  Random random(1);
  constexpr int kBillows = 420, kPuffsOfEach = 40;
  for (int i = 0; i < kBillows; ++i) {
    const int column = i % 3;
    const double height = random(), width = 0.05 + 0.13 * height, strength = random.between(0.2, 1.8);
    const double x =
        0.5 + 0.17 * (column - 1) * (1.6 - height) + 0.04 * std::sin(7 * height + column) + width * random.bell();
    const double depth = 0.17 + 0.32 * column + 0.03 * std::sin(9 * height + 2 * column) + 0.8 * width * random.bell();
    for (int k = 0; k < kPuffsOfEach; ++k) {
      Puff puff{};
      puff.x = x + 0.3 * width * random.bell();
      puff.y = 1.04 * height - 0.02 + 0.3 * width * random.bell();
      puff.depth = depth + 0.06 * width * random.bell();
      puff.radius = random.between(0.01, 0.03) + 0.03 * height * random();
      puff.density = 0.0014 * strength / (puff.radius + 0.01);
      draw(puff, 0.25, scene);
    }
  }
}

/// One hair: from a scalp down, some way to the side and to the back. Where it leaves part of a texel free more passes.
void drawStrand(Random& random, MapScene& scene) {
  const double turn = random.between(0, 2 * kPi), out = std::sqrt(random());
  double x = 0.5 + 0.2 * out * std::cos(turn), y = 0.7 + 0.2 * out * std::sin(turn);
  double depth = 0.55 - 0.35 * std::sqrt(1 - out * out) * (random() < 0.5 ? 1 : -1) + 0.03 * random.bell();
  double driftX = 0.5 * (x - 0.5) + 0.05 * random.bell(), driftDepth = 0.3 * (depth - 0.5) + 0.1 * random.bell();
  const double length = random.between(0.3, 0.6), thickness = random.between(0.001, 0.003),
               phase = random.between(0, 6);
  const double passed = random.between(0.05, 0.3);
  std::uint32_t last = 0xFFFFFFFF;
  const double step = 0.4 / scene.size;
  for (double s = 0; s < length; s += step) {
    const int column = static_cast<int>(std::floor(x * scene.size)), row = static_cast<int>(std::floor(y * scene.size));
    const auto texel = static_cast<std::uint32_t>(row * scene.size + column);
    const double cover = random.between(0.1, 0.8);
    if (column >= 0 && row >= 0 && column < scene.size && row < scene.size && texel != last)
      scene.segments.push_back({texel, static_cast<float>(depth), static_cast<float>(depth + thickness),
                                static_cast<float>(1 - cover * (1 - passed))});
    last = texel;
    x += step * (driftX + 0.15 * std::sin(20 * s + phase));
    y -= step;
    depth += step * driftDepth;
  }
}

void drawHair(MapScene& scene) {
  Random random(2);
  constexpr int kStrands = 11000, kPuffs = 700;
  for (int i = 0; i < kStrands; ++i)
    drawStrand(random, scene);
  for (int i = 0; i < kPuffs; ++i) {
    Puff puff{};
    puff.x = random();
    puff.y = random();
    puff.depth = random.between(0.1, 0.9);
    puff.radius = random.between(0.04, 0.1);
    puff.density = random.between(0.02, 0.1);
    draw(puff, 1, scene);
  }
}

} // namespace

const std::vector<std::string>& mapSceneNames() {
  static const std::vector<std::string> names = {"smoke", "smoke-tenth", "hair", "hair-tenth"};
  return names;
}

MapScene makeMapScene(const std::string& name, int size) {
  MapScene scene{name, size, {}};
  const std::string kind = name.substr(0, name.find('-'));
  if (kind == "smoke")
    drawSmoke(scene);
  else if (kind == "hair")
    drawHair(scene);
  else
    throw host::Error("scene " + name + ": not one of smoke, smoke-tenth, hair, hair-tenth");
  for (DrawnSegment& s : scene.segments) {
    s.entry = std::clamp(s.entry, 0.0F, 1.0F);
    s.exit = std::clamp(s.exit, 0.0F, 1.0F);
    if (kind == name) continue;
    s.entry = 0.45F + 0.1F * s.entry;
    s.exit = 0.45F + 0.1F * s.exit;
  }
  return scene;
}

std::vector<std::vector<reference::Segment>> segmentsByTexel(const MapScene& scene) {
  std::vector<std::vector<reference::Segment>> all(static_cast<std::size_t>(scene.size) *
                                                   static_cast<std::size_t>(scene.size));
  for (const DrawnSegment& s : scene.segments)
    all[s.texel].push_back({s.entry, s.exit, s.transmittance});
  return all;
}

} // namespace avsmbench
