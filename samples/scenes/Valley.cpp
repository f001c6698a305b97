// A valley in the morning: a low sun behind ridges, fog on the valley's floor, and thinner air above it.
#include "Ground.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include "Random.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace scenes {
namespace {

constexpr int kPoints = 441; ///< a side
constexpr double kSide = 7200;

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A trough along z that bends, between mountains that close it at its far end; rivers then cut gullies.
HeightField troughs() {
  HeightField field;
  field.size = kPoints;
  field.cell = kSide / (kPoints - 1);
  const auto place = [&](int x, int y) { return field.cell * glm::dvec2(x, y) - 0.5 * kSide; };
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const glm::dvec2 p = place(x, y);
      const glm::dvec2 warp(fractal(p / 900.0, 4, 5), fractal(p / 900.0, 4, 6));
      const double axis = 420 * noise({p.y / 1900, 3.3}, 9);
      const double side = std::abs(p.x - axis) + 150 * warp.x;
      const double wall = std::max(smooth(190, 1750, side), 0.95 * smooth(1300, 3100, -p.y + 250 * warp.y));
      const double crest = 520 + 620 * ridged(p / 1700.0 + 0.25 * warp, 5, 41);
      const double spurs = 230 * (ridged(p / 640.0 + 0.2 * warp, 5, 52) - 0.45);
      const double floor = 55 + 9 * fractal(p / 260.0, 4, 63) + 0.006 * (0.5 * kSide - p.y);
      field.heights.push_back(floor + wall * (crest + spurs));
    }
  Rivers rivers;
  rivers.erodibility = 0.035;
  rivers.source = 4e3;
  rivers.talus = 1.6;
  rivers.creep = 0.06;
  erode(field, std::vector<double>(field.heights.size(), 0.0), rivers, 10);
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const glm::dvec2 p = place(x, y);
      const double rough = smooth(80, 700, field.at(x, y));
      field.at(x, y) += 30 * rough * (ridged(p / 130.0, 4, 74) - 0.4);
    }
  limitSlope(field, 1.5);
  return field;
}

constexpr double kTreeLine = 620, kSnowLine = 900;

enum Cover { Meadow, Undergrowth, Scree, Rock, DarkRock, Snow };

/// Whether trees grow at a place: in patches, more on slopes, up to a line that frays.
bool isForest(const glm::dvec3& p, const glm::dvec3& normal) {
  const double patches = fractal({p.x / 420, p.z / 420}, 4, 91);
  const bool isFloor = 1 - normal.y < 0.012;
  return normal.y > 0.62 && p.y < kTreeLine + 130 * patches && patches > (isFloor ? 0.18 : -0.22);
}

int coverAt(const glm::dvec3& p, const glm::dvec3& normal, double chance) {
  const double patches = fractal({p.x / 300, p.z / 300}, 5, 17) + 0.04 * (chance - 0.5);
  const double steep = 1 - normal.y;
  if (p.y > kSnowLine + 200 * patches && steep < 0.28 + 0.12 * patches) return Snow;
  if (steep > 0.27 + 0.05 * patches) return patches > 0 ? Rock : DarkRock;
  if (p.y > kTreeLine + 60 + 150 * patches) return steep > 0.12 ? Scree : Rock;
  return isForest(p, normal) ? Undergrowth : Meadow;
}

/// Without its floor.
void cone(MeshBuilder& mesh, const glm::dvec3& foot, double radius, double height, double turn) {
  constexpr int kSides = 5;
  std::array<std::uint32_t, kSides> rim{};
  for (int k = 0; k < kSides; ++k) {
    const double angle = turn + 6.283185307179586 * k / kSides;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    rim[static_cast<std::size_t>(k)] = mesh.vertex(foot + radius * out, glm::normalize(out + glm::dvec3(0, 0.3, 0)));
  }
  const std::uint32_t top = mesh.vertex(foot + glm::dvec3(0, height, 0), {0, 1, 0});
  for (std::size_t k = 0; k < kSides; ++k)
    mesh.triangle(rim[k], top, rim[(k + 1) % kSides]);
}

/// Conifers of two cones each.
void forest(MeshBuilder& mesh, const Ground& ground, const std::array<int, 2>& needles) {
  Random random(5);
  constexpr int kTries = 60000;
  for (int i = 0; i < kTries; ++i) {
    const double x = random.between(-2100, 2100);
    const double z = random.between(-2600, 3300);
    const double size = random.between(0.6, 1.25);
    const double kind = random.unit();
    const double turn = random.between(0, 6.283);
    const double y = ground.height({x, z});
    const int column = static_cast<int>(x / ground.field.cell + 0.5 * (ground.field.size - 1));
    const int row = static_cast<int>(z / ground.field.cell + 0.5 * (ground.field.size - 1));
    if (!isForest({x, y, z}, ground.normal(column, row))) continue;
    mesh.material(needles[kind < 0.6 ? 0 : 1]);
    for (int half = 0; half < 2; ++half) {
      const glm::dvec3 foot(x, y + (half == 0 ? 2.0 : 7.5) * size, z);
      cone(mesh, foot, (half == 0 ? 3.6 : 2.5) * size, (half == 0 ? 10.0 : 11.5) * size, turn + half);
    }
  }
}

} // namespace

Scene makeValley() {
  Scene scene;
  scene.grid = 1.0 / 64;
  Light sun;
  sun.colour = {1.0, 0.78, 0.56};
  sun.intensity = 9;
  sun.direction = {-0.5, -0.2, 0.85};
  scene.lights = {sun};
  scene.camera = {{-150, 330, 2900}, {60, 190, 0}, 50, 2, 20000};
  scene.constituents = {{"rayleigh", {5.8e-6, 13.5e-6, 33.1e-6}, 0, 1},
                        {"henyey-greenstein", glm::dvec3(4e-5), 0.7, 1},
                        {"henyey-greenstein", glm::dvec3(2.6e-3), 0.6, 0}};
  scene.layers = {{110, 38, 50}, {0, 1800, -1000}};
  scene.farDistance = 40000;
  scene.ambient = {0.25, 0.32, 0.45};
  scene.sky = {0.9, 1.15, 1.6};

  const std::vector<int> materials = {
      scene.add({"meadow", {0.075, 0.10, 0.035}}),     scene.add({"undergrowth", {0.035, 0.042, 0.02}}),
      scene.add({"scree", {0.20, 0.185, 0.165}}),      scene.add({"rock", {0.17, 0.15, 0.13}}),
      scene.add({"dark rock", {0.105, 0.095, 0.085}}), scene.add({"snow", {0.82, 0.84, 0.88}})};
  const std::array<int, 2> needles = {scene.add({"spruce", {0.022, 0.04, 0.018}}),
                                      scene.add({"larch", {0.045, 0.055, 0.02}})};
  const Ground ground{troughs()};
  MeshBuilder mesh(scene);
  cover(mesh, ground, coverAt, materials);
  forest(mesh, ground, needles);
  return scene;
}

} // namespace scenes
