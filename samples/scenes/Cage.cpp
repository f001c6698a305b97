// A lantern in a Moorish court: a point light in a pierced sphere, its light in view.
#include "Architecture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

constexpr double kRoom = 6.4; ///< half its side
constexpr double kHeight = 6.6;
constexpr double kRing = 4.65; ///< radius of the ring of columns
constexpr int kColumns = 8;
constexpr double kColumnTop = 3.5;
constexpr glm::dvec3 kLantern(0, 2.9, 0);

struct Palette {
  Masonry plaster;
  Masonry tiles;
  Masonry marble;
  int trim = 0;
  int floorLight = 0;
  int floorDark = 0;
  int floorAccent = 0;
  int beam = 0;
  int iron = 0;
  int brass = 0;
  int horn = 0; ///< thin plates that glow with the lamp inside
};

/// A point of a cell of the sphere; (x, y) in [-1, 1]^2.
struct Cell {
  double longitude = 0;
  double latitude = 0;
  double halfWidth = 0;
  double halfHeight = 0;
  glm::dvec3 at(const glm::dvec2& p, double radius) const {
    const double turn = longitude + p.x * halfWidth;
    const double lift = latitude + p.y * halfHeight;
    return radius * glm::dvec3(std::cos(lift) * std::cos(turn), std::sin(lift), -std::cos(lift) * std::sin(turn));
  }
};

/// A curved plate with a hole like a four-pointed star. Points are even along its edges, so that those of the next row,
/// half a cell aside, are the same and no light leaks between.
void piercedCell(MeshBuilder& mesh, const Palette& p, const Cell& cell, double inner, double outer) {
  constexpr int kPoints = 32;
  std::array<glm::dvec2, kPoints> hole;
  std::array<glm::dvec2, kPoints> edge;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = glm::two_pi<double>() * i / kPoints;
    const glm::dvec2 out(std::cos(angle), std::sin(angle));
    hole[static_cast<std::size_t>(i)] = out * (0.48 + 0.2 * std::cos(4 * angle));
    const auto along = [](int step) {
      return std::clamp(0.25 * std::abs((step + kPoints) % kPoints - 16) - 2, -1.0, 1.0);
    };
    edge[static_cast<std::size_t>(i)] = {along(i), along(i - kPoints / 4)};
  }
  for (std::size_t i = 0; i < kPoints; ++i) {
    const std::size_t j = (i + 1) % kPoints;
    mesh.material(p.horn);
    mesh.quad(cell.at(hole[i], outer), cell.at(edge[i], outer), cell.at(edge[j], outer), cell.at(hole[j], outer));
    mesh.material(p.iron);
    mesh.quad(cell.at(hole[j], inner), cell.at(edge[j], inner), cell.at(edge[i], inner), cell.at(hole[i], inner));
    mesh.quad(cell.at(hole[j], outer), cell.at(hole[j], inner), cell.at(hole[i], inner), cell.at(hole[i], outer));
  }
}

/// Outside bars from the crown to the finial, bulging round the sphere.
void cageBars(MeshBuilder& mesh, double radius) {
  constexpr int kBars = 8;
  for (int i = 0; i < kBars; ++i) {
    const double turn = glm::two_pi<double>() * (i + 0.5) / kBars;
    std::vector<glm::dvec3> path;
    for (int k = 0; k <= 24; ++k) {
      const double lift = glm::pi<double>() * (k / 24.0 - 0.5);
      const double out = radius * (0.16 + 1.12 * std::cos(lift));
      path.emplace_back(out * std::cos(turn), 1.42 * radius * std::sin(lift), -out * std::sin(turn));
    }
    mesh.tube(path, 0.017, 6);
  }
  for (const double lift : {-0.62, 0.0, 0.62})
    mesh.torus({0, 1.42 * radius * std::sin(lift), 0}, radius * (0.16 + 1.12 * std::cos(lift)), 0.018, 8, 48);
}

void chain(MeshBuilder& mesh, double low, double high) {
  const int links = static_cast<int>((high - low) / 0.1);
  for (int i = 0; i < links; ++i) {
    std::vector<glm::dvec3> link;
    for (int k = 0; k < 14; ++k) {
      const double angle = glm::two_pi<double>() * k / 14;
      const double side = 0.035 * std::cos(angle);
      link.emplace_back(i % 2 == 0 ? side : 0, low + (i + 0.5) * (high - low) / links + 0.068 * std::sin(angle),
                        i % 2 == 0 ? 0 : side);
    }
    mesh.bar(link, i % 2 == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), 0.014, 0.014, true);
  }
}

void lantern(MeshBuilder& mesh, const Palette& p) {
  constexpr int kRows = 7;
  constexpr int kCells = 16;
  constexpr double kOuter = 0.55;
  constexpr double kInner = 0.535;
  const double reach = glm::radians(66.0);
  mesh.frame(glm::translate(glm::dmat4(1), kLantern));
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kCells; ++i)
      piercedCell(mesh, p,
                  {glm::two_pi<double>() * (i + 0.5 * (row & 1)) / kCells, reach * ((2 * row + 1.0) / kRows - 1),
                   glm::pi<double>() / kCells, reach / kRows},
                  kInner, kOuter);
  mesh.material(p.brass);
  const double cap = kOuter * std::sin(reach);
  const double ring = kOuter * std::cos(reach);
  mesh.lathe({{ring + 0.02, cap - 0.03},
              {ring + 0.03, cap},
              {ring, cap + 0.03},
              {0.11, cap + 0.06},
              {0.09, cap + 0.12},
              {0.05, cap + 0.15},
              {0.05, 1.42 * kOuter},
              {0.10, 1.44 * kOuter},
              {0.10, 1.48 * kOuter},
              {0, 1.6 * kOuter}},
             24);
  mesh.lathe({{0, -1.85 * kOuter},
              {0.03, -1.78 * kOuter},
              {0.015, -1.68 * kOuter},
              {0.06, -1.55 * kOuter},
              {0.1, -1.46 * kOuter},
              {0.10, -1.42 * kOuter},
              {0.05, -1.36 * kOuter},
              {0.05, -cap - 0.15},
              {0.12, -cap - 0.06},
              {ring, -cap - 0.03},
              {ring + 0.03, -cap},
              {ring + 0.02, -cap + 0.03}},
             24);
  mesh.torus({0, 0, 0}, kOuter + 0.004, 0.012, 8, 56);
  cageBars(mesh, kOuter);
  mesh.material(p.iron);
  chain(mesh, 1.56 * kOuter, kHeight - kLantern.y - 0.3);
}

void arcade(MeshBuilder& mesh, const Palette& p) {
  const double step = glm::two_pi<double>() / kColumns;
  const double half = kRing * std::sin(0.5 * step);
  for (int i = 0; i < kColumns; ++i) {
    const double turn = step * i;
    const double corner = turn + 0.5 * step;
    mesh.frame(glm::rotate(glm::translate(glm::dmat4(1), {kRing * std::sin(corner), 0, kRing * std::cos(corner)}),
                           corner, {0, 1, 0}));
    column(mesh, p.marble, 0.2, kColumnTop, 20, i);
    mesh.material(p.plaster.tones[0]).box({-0.24, kColumnTop, -0.24}, {0.24, kHeight - 0.2, 0.24});
    // The panel's front looks at the court's middle.
    const double apothem = kRing * std::cos(0.5 * step);
    mesh.frame(frameAt({apothem * std::sin(turn), 0, apothem * std::cos(turn)}, {0, 1, 0},
                       {-std::sin(turn), 0, -std::cos(turn)}));
    const Opening arch = lancet(0, half - 0.22, kColumnTop, kColumnTop, 1.62, 18);
    wall(mesh, p.plaster, {-half, half, kColumnTop, kHeight - 0.1, -0.16, 0.16}, arch, arch, 10 + i);
    mesh.material(p.trim);
    for (const double z : {-0.17, 0.17}) {
      mesh.tube(atDepth(archCurve(0, half - 0.2, kColumnTop, 1.65, 18), z), 0.035, 8);
      mesh.tube(atDepth(archCurve(0, half - 0.06, kColumnTop, 1.81, 18), z), 0.025, 8);
    }
    mesh.box({-half, 5.55, -0.22}, {half, 5.68, 0.22});
  }
}

void room(MeshBuilder& mesh, const Palette& p) {
  for (int side = 0; side < 4; ++side) {
    const double turn = 0.5 * glm::pi<double>() * side;
    mesh.frame(
        frameAt({-kRoom * std::sin(turn), 0, -kRoom * std::cos(turn)}, {0, 1, 0}, {std::sin(turn), 0, std::cos(turn)}));
    wall(mesh, p.plaster, {-kRoom - 0.4, kRoom + 0.4, 1.3, kHeight, -0.4, 0}, 30 + side);
    wall(mesh, p.tiles, {-kRoom - 0.4, kRoom + 0.4, -0.2, 1.3, -0.4, 0}, 40 + side);
    mesh.material(p.trim).box({-kRoom, 1.26, -0.1}, {kRoom, 1.36, 0.06});
    mesh.box({-kRoom, 0, -0.1}, {kRoom, 0.16, 0.05});
    mesh.box({-kRoom, 5.5, -0.1}, {kRoom, 5.7, 0.09});
    for (const double x : {-4.25, 0.0, 4.25}) {
      mesh.bar(atDepth(archCurve(x, 1.15, 3.1, 1.5, 14), 0.02), {0, 0, 1}, 0.14, 0.12);
      mesh.box({x - 1.22, 1.3, -0.1}, {x - 1.08, 3.15, 0.08});
      mesh.box({x + 1.08, 1.3, -0.1}, {x + 1.22, 3.15, 0.08});
    }
  }
  mesh.frame(glm::dmat4(1)).material(p.beam);
  mesh.box({-kRoom - 0.4, kHeight - 0.02, -kRoom - 0.4}, {kRoom + 0.4, kHeight + 0.3, kRoom + 0.4});
  for (int i = -6; i <= 6; ++i)
    mesh.box({i * 1.0 - 0.09, kHeight - 0.26, -kRoom}, {i * 1.0 + 0.09, kHeight, kRoom});
}

void pavement(MeshBuilder& mesh, const Palette& p) {
  constexpr int kTiles = 16;
  mesh.frame(glm::dmat4(1))
      .material(p.floorDark)
      .box({-kRoom - 0.4, -0.3, -kRoom - 0.4}, {kRoom + 0.4, -0.01, kRoom + 0.4});
  const double s = kRoom / kTiles;
  for (int i = -kTiles; i < kTiles; ++i)
    for (int j = -kTiles; j < kTiles; ++j) {
      const bool isAccent = (i & 3) == 0 && (j & 3) == 0;
      mesh.material(isAccent ? p.floorAccent : ((i + j) & 1) != 0 ? p.floorLight : p.floorDark);
      mesh.quad({i * s, 0, (j + 1) * s}, {(i + 1) * s, 0, (j + 1) * s}, {(i + 1) * s, 0, j * s}, {i * s, 0, j * s});
    }
  mesh.material(p.marble.tones[0]);
  mesh.lathe({{1.55, -0.01},
              {1.55, 0.1},
              {1.25, 0.1},
              {1.2, 0.46},
              {1.3, 0.52},
              {1.3, 0.6},
              {1.1, 0.6},
              {1.02, 0.5},
              {0.98, 0.3},
              {0.2, 0.24},
              {0.14, 0.3},
              {0.12, 0.85},
              {0.2, 0.9},
              {0.5, 1.02},
              {0.52, 1.08},
              {0.46, 1.08},
              {0.2, 1.0},
              {0, 0.98}},
             8);
}

Palette paint(Scene& scene) {
  Palette p;
  const auto tones = [&](const char* name, std::initializer_list<glm::dvec3> colours) {
    std::vector<int> materials;
    for (const glm::dvec3& colour : colours)
      materials.push_back(scene.add({name, colour}));
    return materials;
  };
  p.plaster = {tones("plaster", {{0.56, 0.42, 0.29}, {0.52, 0.38, 0.26}, {0.60, 0.45, 0.31}}), 0.8, 0.36};
  p.tiles = {tones("tile", {{0.08, 0.24, 0.32}, {0.05, 0.13, 0.34}, {0.55, 0.52, 0.44}, {0.10, 0.34, 0.28}}), 0.1625,
             0.1625};
  p.marble = {tones("marble", {{0.62, 0.58, 0.52}, {0.57, 0.53, 0.47}}), 1, 1};
  p.trim = scene.add({"carved trim", {0.66, 0.54, 0.38}});
  p.floorLight = scene.add({"pale tile", {0.48, 0.40, 0.31}});
  p.floorDark = scene.add({"clay tile", {0.26, 0.12, 0.07}});
  p.floorAccent = scene.add({"blue tile", {0.06, 0.15, 0.34}});
  p.beam = scene.add({"cedar", {0.14, 0.075, 0.04}});
  p.iron = scene.add({"iron", {0.035, 0.03, 0.028}});
  p.brass = scene.add({"brass", {0.42, 0.27, 0.09}});
  p.horn = scene.add({"horn", {0.5, 0.3, 0.12}, {0.75, 0.33, 0.07}});
  return p;
}

} // namespace

Scene makeCage() {
  Scene scene;
  scene.camera = {{0.3, 1.6, 5.85}, {-0.05, 2.8, 0}, 57, 0.1, 40};
  Light lamp;
  lamp.kind = LightKind::Point;
  lamp.name = "lamp";
  lamp.colour = {1.0, 0.74, 0.44};
  lamp.intensity = 190;
  lamp.position = kLantern;
  scene.lights = {lamp};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.018), 0.35}, {"isotropic", glm::dvec3(0.018), 0}};
  scene.absorption = glm::dvec3(0.001);
  scene.sky = {0.075, 0.09, 0.13};

  const Palette palette = paint(scene);
  MeshBuilder mesh(scene);
  room(mesh, palette);
  pavement(mesh, palette);
  arcade(mesh, palette);
  lantern(mesh, palette);
  return scene;
}

} // namespace scenes
