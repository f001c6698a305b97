// Pews, altar, candles and lamps of the church.
#include "Nave.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes::nave {
namespace {

void pew(MeshBuilder& mesh, const Palette& p, double left, double right, double z) {
  mesh.material(p.wood);
  mesh.box({left, 0.42, z - 0.2}, {right, 0.47, z + 0.22});
  mesh.box({left, 0.46, z + 0.2}, {right, 0.95, z + 0.25});
  mesh.box({left, 0.95, z + 0.17}, {right, 1.0, z + 0.29});
  mesh.box({left, 0.1, z - 0.02}, {right, 0.14, z + 0.28});
  mesh.material(p.darkWood);
  for (const double x : {left, right - 0.07}) {
    mesh.box({x, 0.0, z - 0.26}, {x + 0.07, 0.62, z + 0.3});
    mesh.box({x, 0.6, z + 0.1}, {x + 0.07, 1.08, z + 0.3});
    mesh.frame(glm::translate(glm::dmat4(1), {x + 0.035, 1.08, z + 0.2}));
    mesh.lathe({{0.05, 0}, {0.07, 0.06}, {0.05, 0.12}, {0.0, 0.16}}, 8);
    mesh.frame(glm::dmat4(1));
  }
}

/// A candle with its flame; the candlestick stands at `foot`.
void candle(MeshBuilder& mesh, const Palette& p, const glm::dvec3& foot, double height) {
  mesh.frame(glm::translate(glm::dmat4(1), foot));
  mesh.material(p.gold).lathe({{0.14, 0},
                               {0.15, 0.03},
                               {0.06, 0.08},
                               {0.03, 0.12},
                               {0.03, 0.5 * height - 0.05},
                               {0.05, 0.5 * height},
                               {0.03, 0.5 * height + 0.05},
                               {0.03, height - 0.06},
                               {0.09, height},
                               {0.0, height + 0.005}},
                              12);
  mesh.material(p.wax).lathe({{0.032, height}, {0.032, height + 0.28}, {0.0, height + 0.285}}, 10);
  mesh.material(p.flame).lathe(
      {{0.0, height + 0.285}, {0.018, height + 0.315}, {0.014, height + 0.345}, {0.0, height + 0.40}}, 8);
  mesh.frame(glm::dmat4(1));
}

void chancel(MeshBuilder& mesh, const Palette& p) {
  const double end = -kHalfLength;
  for (int step = 0; step < 4; ++step) {
    mesh.material(step % 2 == 0 ? p.rib : p.floorLight);
    const double inset = 0.36 * step;
    mesh.box({-4.1 + inset, step == 0 ? -0.1 : 0.16 * step - 0.02, end - 0.1},
             {4.1 - inset, 0.16 * (step + 1), end + 7.2 - inset});
  }
  const double top = 0.64;
  mesh.material(p.floorLight).box({-1.5, top - 0.1, end + 2.2}, {1.5, top + 0.95, end + 3.3});
  mesh.material(p.rib).box({-1.65, top + 0.95, end + 2.1}, {1.65, top + 1.05, end + 3.4});
  mesh.material(p.cloth).box({-0.55, top + 0.12, end + 3.29}, {0.55, top + 1.07, end + 3.42});
  mesh.box({-0.95, 0.0, end + 5.2}, {0.95, top + 0.012, end + 6.0});
  mesh.box({-0.95, -0.02, end + 7.0}, {0.95, 0.012, kHalfLength - 3});
  mesh.material(p.gold);
  mesh.box({-0.05, top + 1.04, end + 2.35}, {0.05, top + 2.5, end + 2.43});
  mesh.box({-0.42, top + 1.95, end + 2.35}, {0.42, top + 2.05, end + 2.43});
  mesh.box({-0.2, top + 1.04, end + 2.25}, {0.2, top + 1.14, end + 2.53});
  for (const double x : {-1.4, -1.05, -0.7, 0.7, 1.05, 1.4})
    candle(mesh, p, {x, top + 1.05, end + 2.5}, 0.45);
  for (const double x : {-2.3, 2.3})
    candle(mesh, p, {x, top, end + 4.2}, 1.5);
}

/// A ring of candles on three chains.
void chandelier(MeshBuilder& mesh, const Palette& p, double z, double y) {
  mesh.material(p.darkWood).torus({0, y, z}, 0.85, 0.035, 8, 40);
  mesh.torus({0, y - 0.22, z}, 0.45, 0.025, 8, 28);
  mesh.tube({{0, y + 1.6, z}, {0, 15.4, z}}, 0.018, 6);
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5235987755982988 * i;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    const glm::dvec3 rim = glm::dvec3(0, y, z) + 0.85 * out;
    mesh.material(p.darkWood);
    if (i % 4 == 0) mesh.tube({rim, {0, y + 1.62, z}}, 0.014, 6);
    if (i % 2 == 0) mesh.tube({rim, glm::dvec3(0, y - 0.22, z) + 0.45 * out}, 0.014, 6);
    mesh.frame(glm::translate(glm::dmat4(1), rim));
    mesh.material(p.wax).lathe({{0.028, 0.02}, {0.028, 0.2}, {0, 0.205}}, 8);
    mesh.material(p.flame).lathe({{0, 0.205}, {0.02, 0.24}, {0.016, 0.27}, {0, 0.33}}, 8);
    mesh.frame(glm::dmat4(1));
  }
}

} // namespace

void furnish(MeshBuilder& mesh, const Palette& palette) {
  chancel(mesh, palette);
  for (int row = 0; row < 13; ++row) {
    const double z = -9.2 + 1.15 * row;
    pew(mesh, palette, -4.0, -1.15, z);
    pew(mesh, palette, 1.15, 4.0, z);
  }
  for (const double z : {-8.25, 2.75})
    chandelier(mesh, palette, z, 6.2);
}

} // namespace scenes::nave
