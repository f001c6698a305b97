// The church after the SIBENIK scenes of Chen et al. 2011: a three-aisled basilica with sun from its right side.
#include "Nave.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace nave {
namespace {

constexpr double kCapital = 5.2;  ///< top of the columns
constexpr double kGallery = 8.2;  ///< top of the arcade wall, below the clerestory
constexpr double kWallTop = 17.3; ///< under the roof
constexpr double kWall = 1.0;     ///< thickness of the outer walls
constexpr double kRoseRadius = 2.75;
constexpr glm::dvec2 kRose(0, 11.9);

const Vault kNaveVault{kArcadeX - kArcadeHalf, 0.5 * kBay, 11.4, 4.7, 0.24};
const Vault kAisleVault{0.5 * (kAisleX - kArcadeX - kArcadeHalf), 0.5 * kBay, 5.2, 2.6, 0.18};

struct Context {
  MeshBuilder& mesh;
  const Palette& palette;
  bool glazed;
};

double bayCentre(int bay) { return (bay + 0.5) * kBay - kHalfLength; }

/// A frame against the wall at x, facing the nave's middle; side +1 is the right (sun) side, -1 its mirror image.
glm::dmat4 sideFrame(double side, double x, double z) {
  return glm::scale(glm::dmat4(1), {side, 1, 1}) * frameAt({x, 0, z}, {0, 1, 0}, {-1, 0, 0});
}

/// A mullion, two small arches and an oculus under the arch of a window.
void tracery(MeshBuilder& mesh, const Opening& window, double z) {
  const double left = window.x.front();
  const double right = window.x.back();
  const double half = 0.5 * (right - left);
  const double centre = 0.5 * (left + right);
  const double spring = window.high.front();
  const double crown = window.high[window.high.size() / 2];
  const double oculus = 0.34 * half;
  mesh.bar({{centre, window.low.front(), z}, {centre, spring + 0.1, z}}, {0, 0, 1}, 0.08, 0.2);
  for (const double middle : {centre - 0.5 * half, centre + 0.5 * half})
    mesh.bar(atDepth(archCurve(middle, 0.5 * half, spring - 0.25, 0.62 * half, 8), z), {0, 0, 1}, 0.09, 0.18);
  mesh.bar(atDepth(circleCurve({centre, 0.5 * (spring + crown) + 0.1 * half}, oculus, 20), z), {0, 0, 1}, 0.09, 0.18,
           true);
  mesh.bar(atDepth(window.outline(), z), {0, 0, 1}, 0.12, 0.2, true);
}

/// A wall panel with a window in the frame's local coordinates.
void windowWall(const Context& c, const Panel& panel, const Opening& inside, const Opening& outside, int seed) {
  wall(c.mesh, c.palette.stone, panel, inside, outside, seed);
  const double weight = 0.6;
  const double z = panel.front + weight * (panel.back - panel.front);
  const Opening middle = between(inside, outside, weight);
  c.mesh.material(c.palette.rib);
  tracery(c.mesh, middle, z);
  if (c.glazed) glazeLancet(c.mesh, c.palette.glass, middle.outline(), z, seed);
}

void arcadeBay(const Context& c, double side, int bay) {
  const int seed = bay * 2 + (side > 0 ? 1 : 0);
  c.mesh.frame(sideFrame(side, kArcadeX, bayCentre(bay)));
  const double half = 0.5 * kBay;
  const Opening arch = lancet(0, half - 0.5, kCapital, kCapital, 2.4, 13);
  wall(c.mesh, c.palette.stone, {-half, half, kCapital, kGallery, -kArcadeHalf, kArcadeHalf}, arch, arch, seed + 40);
  c.mesh.material(c.palette.rib);
  for (const double z : {-kArcadeHalf, kArcadeHalf}) {
    c.mesh.tube(atDepth(archCurve(0, half - 0.44, kCapital, 2.47, 13), z), 0.09, 6);
    c.mesh.tube(atDepth(archCurve(0, half - 0.22, kCapital, 2.72, 13), z), 0.06, 6);
  }
  windowWall(c, {-half, half, kGallery, kWallTop, -kArcadeHalf, kArcadeHalf}, lancet(0, 0.85, 10.0, 12.2, 1.45, 12),
             lancet(0, 0.62, 10.2, 12.2, 1.15, 12), seed);
}

void aisleBay(const Context& c, double side, int bay) {
  const int seed = 20 + bay * 2 + (side > 0 ? 1 : 0);
  const double half = 0.5 * kBay;
  c.mesh.frame(sideFrame(side, kAisleX, bayCentre(bay)));
  windowWall(c, {-half, half, -0.4, kGallery, -kWall, 0}, lancet(0, 0.85, 1.9, 4.9, 1.4, 12),
             lancet(0, 0.6, 2.1, 4.9, 1.15, 12), seed);
  c.mesh.frame(glm::translate(glm::dmat4(1), {side * (kAisleX - kAisleVault.halfX), 0, bayCentre(bay)}));
  vault(c.mesh, c.palette.web, c.palette.rib, kAisleVault, seed);
}

/// Columns, wall shafts and arches on a line between bays (or at an end of the arcade).
void pier(const Context& c, double side, int line) {
  MeshBuilder& mesh = c.mesh;
  const double z = line * kBay - kHalfLength;
  mesh.frame(glm::translate(glm::dmat4(1), {side * kArcadeX, 0, z}));
  column(mesh, c.palette.pillars, 0.44, kCapital, 24, line * 2 + (side > 0 ? 1 : 0));
  mesh.frame(sideFrame(side, kArcadeX - kArcadeHalf, z));
  mesh.material(c.palette.rib);
  for (const double x : {-0.2, 0.0, 0.2})
    mesh.tube({{x, kCapital - 0.05, x == 0 ? 0.12 : 0.02}, {x, kNaveVault.spring - 0.2, x == 0 ? 0.12 : 0.02}},
              x == 0 ? 0.13 : 0.1, 10);
  mesh.box({-0.4, kNaveVault.spring - 0.35, -0.1}, {0.4, kNaveVault.spring - 0.1, 0.34});
  mesh.prism({{-0.28, kNaveVault.spring - 0.7},
              {0.28, kNaveVault.spring - 0.7},
              {0.38, kNaveVault.spring - 0.35},
              {-0.38, kNaveVault.spring - 0.35}},
             -0.1, 0.28);
  mesh.frame(sideFrame(side, kAisleX, z));
  mesh.box({-0.32, 0, -0.1}, {0.32, 0.5, 0.26});
  mesh.tube({{0, 0.4, 0.02}, {0, kAisleVault.spring - 0.2, 0.02}}, 0.2, 12);
  mesh.box({-0.3, kAisleVault.spring - 0.25, -0.1}, {0.3, kAisleVault.spring, 0.26});
  mesh.frame(glm::translate(glm::dmat4(1), {side * (kAisleX - kAisleVault.halfX), 0, z}));
  transverseArch(mesh, kAisleVault, 0.3, 0.4);
}

/// Buttresses on the sun's side: lit stone that is seen through the windows there.
void buttresses(const Context& c, int line) {
  const double z = line * kBay - kHalfLength;
  const double wall = kArcadeX + kArcadeHalf - 0.1;
  const double out = kAisleX + kWall;
  c.mesh.frame(glm::dmat4(1)).material(c.palette.stone.tones[2]);
  c.mesh.prism({{wall, kGallery + 0.2}, {out, kGallery + 0.2}, {out, 9.6}, {wall, 15.4}}, z - 0.35, z + 0.35);
  c.mesh.prism({{out - 0.1, -0.4}, {out + 2, -0.4}, {out + 1.7, 4.6}, {out - 0.1, 7}}, z - 0.4, z + 0.4);
}

/// Mouldings that run along the nave and hide the seams between storeys.
void mouldings(const Context& c, double side) {
  MeshBuilder& mesh = c.mesh;
  mesh.frame(sideFrame(side, kArcadeX, 0)).material(c.palette.rib);
  const double l = kHalfLength;
  mesh.box({-l, kGallery - 0.1, kArcadeHalf - 0.1}, {l, kGallery + 0.04, kArcadeHalf + 0.09});
  mesh.box({-l, kGallery + 0.03, kArcadeHalf - 0.1}, {l, kGallery + 0.14, kArcadeHalf + 0.15});
  mesh.box({-l, kGallery - 0.2, -kArcadeHalf - 0.2}, {l, kGallery + 0.2, -kArcadeHalf + 0.1});
  mesh.frame(sideFrame(side, kAisleX, 0));
  mesh.box({-l, -0.1, -0.1}, {l, 0.42, 0.14});
  mesh.box({-l, 1.45, -0.1}, {l, 1.57, 0.07});
}

void rose(const Context& c, double z) {
  constexpr int kPetals = 12;
  MeshBuilder& mesh = c.mesh;
  const double r = kRoseRadius;
  mesh.material(c.palette.rib);
  const auto ring = [&](double radius, double width) {
    mesh.bar(atDepth(circleCurve(kRose, radius, 48), z), {0, 0, 1}, width, 0.22, true);
  };
  ring(0.17 * r, 0.1);
  ring(r - 0.05, 0.16);
  const auto at = [&](double radius, double petal) {
    const double angle = glm::two_pi<double>() * petal / kPetals;
    return kRose + radius * glm::dvec2(std::cos(angle), std::sin(angle));
  };
  for (int petal = 0; petal < kPetals; ++petal) {
    const double spoke = petal + 0.5;
    mesh.bar({{at(0.17 * r, spoke), z}, {at(0.64 * r, spoke), z}}, {0, 0, 1}, 0.085, 0.2);
    std::vector<glm::dvec3> head;
    for (int i = 0; i <= 10; ++i) {
      const double t = i / 10.0;
      const double bulge = std::sqrt(std::max(0.0, 1 - (2 * t - 1) * (2 * t - 1)));
      head.emplace_back(at(r * (0.62 + 0.13 * bulge), spoke + t), z);
    }
    mesh.bar(head, {0, 0, 1}, 0.075, 0.18);
    mesh.bar(atDepth(circleCurve(at(0.845 * r, spoke), 0.125 * r, 16), z), {0, 0, 1}, 0.07, 0.18, true);
  }
  if (c.glazed) glazeRose(mesh, c.palette.glass, kRose, r, kPetals, z);
}

void eastWall(const Context& c) {
  MeshBuilder& mesh = c.mesh;
  mesh.frame(glm::translate(glm::dmat4(1), {0, 0, -kHalfLength}));
  const double edge = kArcadeX + kArcadeHalf;
  const double cut = 1.5;
  const double edges[4] = {-edge, -cut, cut, edge};
  for (int i = 0; i < 3; ++i) {
    const double centre = i == 1 ? 0 : (i - 1) * 3.0;
    windowWall(c, {edges[i], edges[i + 1], -0.4, kGallery, -kWall, 0}, lancet(centre, 0.85, 2.6, 5.7, 1.35, 14),
               lancet(centre, 0.65, 2.8, 5.7, 1.1, 14), 60 + i);
  }
  const Opening inside = roundOpening(kRose, kRoseRadius + 0.3, 48);
  const Opening outside = roundOpening(kRose, kRoseRadius, 48);
  wall(mesh, c.palette.stone, {-edge, edge, kGallery, kWallTop, -kWall, 0}, inside, outside, 70);
  rose(c, -kWall + 0.12);
  mesh.material(c.palette.rib).box({-kArcadeX, kGallery - 0.12, -0.1}, {kArcadeX, kGallery + 0.14, 0.16});
  mesh.bar(atDepth(circleCurve(kRose, kRoseRadius + 0.36, 48), 0.02), {0, 0, 1}, 0.16, 0.14, true);
  for (const double side : {-1.0, 1.0}) {
    const double a = side * edge;
    const double b = side * (kAisleX + kWall);
    wall(mesh, c.palette.stone, {std::min(a, b), std::max(a, b), -0.4, kGallery + 0.3, -kWall, 0}, 72);
  }
}

/// The entrance wall behind the camera, the floor and the roofs: what closes the shell.
void shell(const Context& c) {
  MeshBuilder& mesh = c.mesh;
  const double out = kAisleX + kWall;
  const double edge = kArcadeX + kArcadeHalf;
  const double end = kHalfLength + kWall;
  mesh.frame(frameAt({0, 0, kHalfLength}, {0, 1, 0}, {0, 0, -1}));
  wall(mesh, c.palette.stone, {-out, out, -0.4, kGallery + 0.3, -kWall, 0}, 80);
  wall(mesh, c.palette.stone, {-edge, edge, kGallery + 0.3, kWallTop, -kWall, 0}, 81);
  mesh.material(c.palette.darkWood).box({-1.5, 0, -0.1}, {1.5, 3.6, 0.08});
  mesh.frame(glm::dmat4(1)).material(c.palette.stone.tones[0]);
  mesh.box({-out, -0.7, -end}, {out, -0.02, end});
  mesh.box({-edge - 0.3, kWallTop - 0.3, -end}, {edge + 0.3, kWallTop + 0.3, end});
  mesh.box({edge - 0.1, kGallery - 0.15, -end}, {out, kGallery + 0.3, end});
  mesh.box({-out, kGallery - 0.15, -end}, {0.1 - edge, kGallery + 0.3, end});
  constexpr double kTile = 0.6875;
  const auto across = static_cast<int>(std::ceil(kAisleX / kTile));
  const auto along = static_cast<int>(std::ceil(kHalfLength / kTile));
  for (int i = -across; i < across; ++i)
    for (int j = -along; j < along; ++j) {
      mesh.material((i + j) % 2 == 0 ? c.palette.floorLight : c.palette.floorDark);
      mesh.quad({i * kTile, 0, (j + 1) * kTile}, {(i + 1) * kTile, 0, (j + 1) * kTile}, {(i + 1) * kTile, 0, j * kTile},
                {i * kTile, 0, j * kTile});
    }
}

void naveVaults(const Context& c) {
  for (int bay = 0; bay < kBays; ++bay) {
    c.mesh.frame(glm::translate(glm::dmat4(1), {0, 0, bayCentre(bay)}));
    vault(c.mesh, c.palette.web, c.palette.rib, kNaveVault, 90 + bay);
  }
  for (int line = 0; line <= kBays; ++line) {
    c.mesh.frame(glm::translate(glm::dmat4(1), {0, 0, line * kBay - kHalfLength}));
    transverseArch(c.mesh, kNaveVault, 0.42, 0.5);
  }
}

/// Bright sheets outside the windows that look away from the sun: the sky that is seen through them.
void daylight(const Context& c) {
  MeshBuilder& mesh = c.mesh;
  mesh.frame(glm::dmat4(1)).material(c.palette.daylight);
  const double l = kHalfLength + 0.5;
  const double x = -(kAisleX + kWall + 0.3);
  mesh.quad({x, 0, l}, {x, 0, -l}, {x, kGallery, -l}, {x, kGallery, l});
  const double y = -(kArcadeX + kArcadeHalf + 0.5);
  mesh.quad({y, kGallery + 0.4, l}, {y, kGallery + 0.4, -l}, {y, kWallTop - 1.5, -l}, {y, kWallTop - 1.5, l});
  const double z = -(kHalfLength + kWall + 0.3);
  mesh.quad({-4.6, 1, z}, {4.6, 1, z}, {4.6, kWallTop - 1.5, z}, {-4.6, kWallTop - 1.5, z});
}

Palette paint(Scene& scene, bool glazed) {
  Palette p;
  const auto tones = [&](const char* name, const glm::dvec3& colour, std::initializer_list<double> factors) {
    std::vector<int> materials;
    for (const double factor : factors)
      materials.push_back(scene.add({name, colour * factor}));
    return materials;
  };
  p.stone = {tones("stone", {0.50, 0.42, 0.32}, {1.0, 0.82, 1.16, 0.92, 1.07}), 1.1, 0.46};
  p.web = {tones("vault", {0.56, 0.50, 0.41}, {1.0, 0.9, 1.08}), 1, 1};
  p.pillars = {tones("pillar", {0.46, 0.39, 0.31}, {0.95, 1.06, 1.0, 1.12}), 1, 1};
  p.rib = scene.add({"dressed stone", {0.60, 0.52, 0.41}});
  p.floorLight = scene.add({"pale marble", {0.52, 0.49, 0.44}});
  p.floorDark = scene.add({"dark marble", {0.16, 0.13, 0.12}});
  p.wood = scene.add({"oak", {0.17, 0.09, 0.045}});
  p.darkWood = scene.add({"dark oak", {0.08, 0.045, 0.025}});
  p.cloth = scene.add({"red cloth", {0.42, 0.03, 0.03}});
  p.gold = scene.add({"gilding", {0.75, 0.52, 0.15}});
  p.wax = scene.add({"wax", {0.85, 0.8, 0.66}});
  p.flame = scene.add({"flame", {1, 0.8, 0.4}, {1.0, 0.72, 0.3}});
  p.daylight = scene.add({"daylight", {0, 0, 0}, {0.72, 0.85, 1.0}});
  if (glazed) p.glass = addGlass(scene);
  return p;
}

} // namespace
} // namespace nave

Scene makeNave(bool glazed) {
  using namespace nave;
  Scene scene;
  scene.camera = {{3.3, 1.6, 15.9}, {-1.7, 5.5, -4.0}, 62, 0.1, 120};
  Light sun;
  sun.colour = {1.0, 0.86, 0.64};
  sun.intensity = glazed ? 120 : 52;
  sun.direction = {-0.72, -0.66, -0.15};
  scene.lights = {sun};
  const glm::dvec3 scattering(glazed ? 0.019 : 0.015);
  scene.constituents = {{"henyey-greenstein", scattering, 0.3}, {"isotropic", scattering, 0}};
  scene.absorption = glm::dvec3(0.0008);
  scene.sky = glazed ? glm::dvec3(0.17, 0.155, 0.145) : glm::dvec3(0.27, 0.25, 0.225);

  const Palette palette = paint(scene, glazed);
  MeshBuilder mesh(scene);
  const Context context{mesh, palette, glazed};
  shell(context);
  eastWall(context);
  naveVaults(context);
  for (int line = 0; line <= kBays; ++line)
    buttresses(context, line);
  for (const double side : {-1.0, 1.0}) {
    for (int bay = 0; bay < kBays; ++bay) {
      arcadeBay(context, side, bay);
      aisleBay(context, side, bay);
    }
    for (int line = 0; line <= kBays; ++line)
      pier(context, side, line);
    mouldings(context, side);
  }
  daylight(context);
  mesh.frame(glm::dmat4(1));
  furnish(mesh, palette);
  return scene;
}

} // namespace scenes
