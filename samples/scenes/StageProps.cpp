#include "Stage.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes::stage {
namespace {

void chair(MeshBuilder& mesh, const glm::dvec3& place, double turn) {
  mesh.frame(glm::rotate(glm::translate(glm::dmat4(1), place), turn, {0, 1, 0}));
  mesh.box({-0.22, 0.44, -0.22}, {0.22, 0.48, 0.22});
  for (const double x : {-0.2, 0.2}) {
    mesh.tube({{x, 0, 0.2}, {x, 0.45, 0.19}}, 0.018, 8);
    mesh.tube({{x, 0, -0.24}, {x, 0.45, -0.2}, {x, 0.95, -0.27}}, 0.018, 8);
  }
  for (const double y : {0.62, 0.78, 0.9})
    mesh.bar({{-0.2, y, -0.235}, {0.0, y, -0.265}, {0.2, y, -0.235}}, {0, 1, 0}, 0.02, 0.06);
}

void musicStand(MeshBuilder& mesh, const Palette& p, const glm::dvec3& place, double turn) {
  mesh.frame(glm::rotate(glm::translate(glm::dmat4(1), place), turn, {0, 1, 0}));
  mesh.material(p.blackSteel).tube({{0, 0.02, 0}, {0, 1.0, 0}}, 0.012, 8);
  for (int i = 0; i < 3; ++i) {
    const double angle = glm::two_pi<double>() * i / 3;
    mesh.tube({{0.28 * std::cos(angle), 0.01, 0.28 * std::sin(angle)}, {0, 0.22, 0}}, 0.01, 6);
  }
  mesh.quad({-0.24, 0.95, 0.06}, {0.24, 0.95, 0.06}, {0.24, 1.25, -0.06}, {-0.24, 1.25, -0.06});
  mesh.quad({-0.24, 1.25, -0.061}, {0.24, 1.25, -0.061}, {0.24, 0.95, 0.059}, {-0.24, 0.95, 0.059});
  mesh.material(p.paper).quad({-0.2, 0.97, 0.062}, {0.2, 0.97, 0.062}, {0.2, 1.22, -0.038}, {-0.2, 1.22, -0.038});
}

void microphone(MeshBuilder& mesh, const glm::dvec3& place) {
  mesh.frame(glm::translate(glm::dmat4(1), place));
  mesh.lathe({{0.17, 0},
              {0.17, 0.03},
              {0.02, 0.05},
              {0.013, 0.06},
              {0.013, 1.45},
              {0.03, 1.5},
              {0.045, 1.56},
              {0.045, 1.62},
              {0.02, 1.66},
              {0, 1.67}},
             14);
}

/// A fluted column whose top is broken off.
void ruin(MeshBuilder& mesh, const glm::dvec3& place, double height) {
  constexpr int kFlutes = 16;
  mesh.frame(glm::translate(glm::dmat4(1), place));
  mesh.box({-0.42, 0, -0.42}, {0.42, 0.14, 0.42});
  mesh.lathe({{0.4, 0.12}, {0.42, 0.2}, {0.36, 0.27}, {0.3, 0.3}}, 32);
  const auto radius = [](double turn) { return 0.27 + 0.018 * std::cos(kFlutes * turn); };
  mesh.sheet(kFlutes * 6, 6, [&](double u, double v) {
    const double turn = u < 1 ? glm::two_pi<double>() * u : 0;
    const double top = height + 0.16 * std::sin(turn) + 0.07 * std::cos(3 * turn);
    const double r = radius(turn) * (1 - 0.12 * v);
    return glm::dvec3(r * std::cos(turn), 0.28 + v * (top - 0.28), -r * std::sin(turn));
  });
  mesh.sheet(kFlutes * 6, 2, [&](double u, double v) {
    const double turn = u < 1 ? glm::two_pi<double>() * u : 0;
    const double top = height + (1 - v) * (0.16 * std::sin(turn) + 0.07 * std::cos(3 * turn));
    const double r = radius(turn) * 0.88 * (1 - v);
    return glm::dvec3(r * std::cos(turn), top, -r * std::sin(turn));
  });
}

} // namespace

void truss(MeshBuilder& mesh, const glm::dvec3& a, const glm::dvec3& b, double side) {
  const double length = glm::distance(a, b);
  const glm::dvec3 along = (b - a) / length;
  const glm::dvec3 across =
      glm::normalize(glm::cross(along, std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1)));
  const glm::dvec3 up = glm::cross(across, along);
  const int panels = std::max(2, static_cast<int>(length / (1.25 * side)));
  const auto at = [&](int corner, double t) {
    const double x = corner == 0 || corner == 3 ? -0.5 : 0.5;
    const double y = corner < 2 ? -0.5 : 0.5;
    return a + along * (length * t) + side * (across * x + up * y);
  };
  for (int corner = 0; corner < 4; ++corner) {
    mesh.tube({at(corner, 0), at(corner, 1)}, 0.028, 8);
    const int other = (corner + 1) % 4;
    for (int i = 0; i < panels; ++i) {
      const double from = static_cast<double>(i) / panels;
      const double to = static_cast<double>(i + 1) / panels;
      mesh.tube({at(i % 2 == 0 ? corner : other, from), at(i % 2 == 0 ? other : corner, to)}, 0.014, 6);
      mesh.tube({at(corner, from), at(other, from)}, 0.014, 6);
    }
  }
}

void lampHousing(MeshBuilder& mesh) {
  mesh.lathe({{0, -0.34},
              {0.09, -0.33},
              {0.13, -0.28},
              {0.14, -0.2},
              {0.14, 0.2},
              {0.16, 0.2},
              {0.16, 0.23},
              {0.128, 0.23},
              {0.128, -0.05},
              {0, -0.05}},
             20);
  for (const double y : {-0.24, -0.18, -0.12})
    mesh.torus({0, y, 0}, 0.142, 0.012, 6, 20);
  mesh.bar({{-0.2, -0.05, 0}, {-0.2, -0.42, 0}, {0.2, -0.42, 0}, {0.2, -0.05, 0}}, {0, 0, 1}, 0.02, 0.05);
  mesh.tube({{-0.21, -0.05, 0}, {-0.13, -0.05, 0}}, 0.025, 8);
  mesh.tube({{0.13, -0.05, 0}, {0.21, -0.05, 0}}, 0.025, 8);
}

void louvre(MeshBuilder& mesh, double distance, double halfWidth, int slats) {
  const double w = halfWidth;
  mesh.bar({{-w, distance, -w}, {w, distance, -w}, {w, distance, w}, {-w, distance, w}}, {0, 1, 0}, 0.03, 0.06, true);
  for (int i = 0; i < slats; ++i) {
    const double x = w * ((2 * i + 1.0) / slats - 1);
    const double thick = 0.48 * w / slats;
    mesh.box({x - thick, distance - 0.012, -w}, {x + thick, distance + 0.012, w});
  }
  for (const double x : {-w, w})
    mesh.tube({{x, distance, 0}, {0.8 * x, 0.15, 0}}, 0.01, 6);
}

void wheel(MeshBuilder& mesh, double distance, double radius, int spokes) {
  mesh.torus({0, distance, 0}, radius, 0.016, 8, 40);
  mesh.torus({0, distance, 0}, 0.55 * radius, 0.012, 8, 32);
  mesh.lathe(
      {{0, distance - 0.01}, {0.2 * radius, distance - 0.01}, {0.2 * radius, distance + 0.01}, {0, distance + 0.01}},
      20);
  for (int i = 0; i < spokes; ++i) {
    const double angle = glm::two_pi<double>() * i / spokes;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    const glm::dvec3 hub(0, distance, 0);
    mesh.bar({hub + out * (0.15 * radius), hub + out * radius}, {0, 1, 0}, 0.45 * radius / spokes * 3, 0.012);
  }
  for (const double x : {-radius, radius})
    mesh.tube({{x, distance, 0}, {0.14 * x / radius, 0.18, 0}}, 0.01, 6);
}

void props(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.wood);
  for (int step = 0; step < 3; ++step) {
    const double half = 2.3 - 0.42 * step;
    mesh.box({-half, kFloor - 0.02, -5.6}, {half, kFloor + 0.22 * (step + 1), -3.1 - 0.45 * step});
  }
  mesh.material(p.plaster);
  ruin(mesh, {-3.4, kFloor, -4.6}, 2.9);
  ruin(mesh, {3.5, kFloor, -4.9}, 2.2);
  ruin(mesh, {4.6, kFloor, -3.3}, 0.9);
  mesh.frame(glm::translate(glm::dmat4(1), {0, kFloor + 0.66, -4.7}));
  mesh.box({-0.35, -0.02, -0.35}, {0.35, 0.5, 0.35});
  mesh.lathe({{0.2, 0.5},
              {0.24, 0.53},
              {0.16, 0.6},
              {0.12, 0.7},
              {0.2, 0.82},
              {0.42, 1.05},
              {0.52, 1.32},
              {0.46, 1.52},
              {0.3, 1.64},
              {0.26, 1.76},
              {0.34, 1.86},
              {0.36, 1.9},
              {0.3, 1.9},
              {0.22, 1.76},
              {0, 1.7}},
             36);
  for (const double side : {-1.0, 1.0})
    mesh.tube({{side * 0.44, 1.5, 0},
               {side * 0.66, 1.62, 0},
               {side * 0.68, 1.84, 0},
               {side * 0.5, 1.94, 0},
               {side * 0.32, 1.86, 0}},
              0.03, 8);
  mesh.material(p.gilding);
  const glm::dvec3 places[3] = {{-1.7, kFloor, -1.8}, {0.5, kFloor, -2.3}, {2.3, kFloor, -1.7}};
  const double turns[3] = {0.5, -0.1, -0.6};
  for (int i = 0; i < 3; ++i) {
    mesh.material(p.gilding);
    chair(mesh, places[i], turns[i]);
    musicStand(mesh, p, places[i] + glm::dvec3(0.6 * std::sin(turns[i]), 0, 0.6 * std::cos(turns[i])),
               turns[i] + glm::pi<double>());
  }
  mesh.material(p.blackSteel);
  microphone(mesh, {-0.6, kFloor, -0.9});
  mesh.frame(glm::dmat4(1));
}

void seats(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.seat);
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 14; ++i) {
      const double x = (i - 6.5) * 0.62 + 0.2 * (row % 2);
      const double z = 3.4 + 1.15 * row;
      const double y = 0.18 * row;
      Outline back;
      back.emplace_back(x - 0.26, y + 0.3);
      back.emplace_back(x + 0.26, y + 0.3);
      for (int k = 0; k <= 8; ++k) {
        const double angle = glm::pi<double>() * k / 8;
        back.emplace_back(x + 0.26 * std::cos(angle), y + 0.88 + 0.12 * std::sin(angle));
      }
      mesh.prism(back, z, z + 0.09);
      mesh.box({x - 0.26, y + 0.38, z - 0.5}, {x + 0.26, y + 0.48, z + 0.02});
      mesh.box({x - 0.04 - 0.31, y - 0.1, z - 0.5}, {x + 0.04 - 0.31, y + 0.62, z});
    }
}

} // namespace scenes::stage
