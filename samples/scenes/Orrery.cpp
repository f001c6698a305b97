// A vaulted hall with tall windows in which a brass orrery turns: the shadows of its bodies sweep through the shafts.
#include "Orrery.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace orrery {
namespace {

constexpr double kHalfWidth = 6.6;
constexpr double kBack = -8.0;  ///< the wall at the far end
constexpr double kFront = 12.0; ///< the wall behind the camera
constexpr double kBay = 5.0;
constexpr int kBays = 4;
constexpr double kWall = 0.9;     ///< thickness of the walls
constexpr double kWallTop = 12.6; ///< under the roof
const Vault kVault{kHalfWidth, 0.5 * kBay, 8.0, 4.0, 0.26};
const glm::dvec2 kRound(0, 7.4); ///< middle of the window in the far wall
constexpr double kRoundRadius = 2.1;

double bayCentre(int bay) { return kBack + (bay + 0.5) * kBay; }

/// A frame against the left (-1) or the right (1) wall, facing the middle of the hall.
glm::dmat4 sideFrame(double side, double z) { return frameAt({side * kHalfWidth, 0, z}, {0, 1, 0}, {-side, 0, 0}); }

void leftBay(MeshBuilder& mesh, const Palette& p, int bay) {
  const double half = 0.5 * kBay;
  mesh.frame(sideFrame(-1, bayCentre(bay)));
  const Opening inside = lancet(0, 1.65, 2.7, 7.8, 2.7, 12);
  const Opening outside = lancet(0, 1.45, 2.9, 7.8, 2.4, 12);
  wall(mesh, p.stone, {-half, half, -0.2, kWallTop, -kWall, 0}, inside, outside, 10 + bay);
  mesh.material(p.lead);
  const double z = -0.7 * kWall;
  mesh.bar({{0, 2.8, z}, {0, 10.1, z}}, {0, 0, 1}, 0.09, 0.16);
  for (const double y : {5.3, 7.8})
    mesh.bar({{-1.7, y, z}, {1.7, y, z}}, {0, 0, 1}, 0.08, 0.14);
}

void rightBay(MeshBuilder& mesh, const Palette& p, int bay) {
  const double half = 0.5 * kBay;
  mesh.frame(sideFrame(1, bayCentre(bay)));
  wall(mesh, p.stone, {-half, half, -0.2, kWallTop, -kWall, 0}, 30 + bay);
  mesh.material(p.rib).tube(atDepth(archCurve(0, 1.7, 6.4, 2.6, 12), 0.02), 0.1, 8); // a blind arch
  for (const double x : {-1.7, 1.7})
    mesh.tube({{x, 0, 0.02}, {x, 6.4, 0.02}}, 0.1, 8);
}

/// Wall shafts and the arch between two bays.
void line(MeshBuilder& mesh, const Palette& p, int index) {
  const double z = kBack + index * kBay;
  for (const double side : {-1.0, 1.0}) {
    mesh.frame(sideFrame(side, z)).material(p.rib);
    mesh.box({-0.42, -0.1, -0.1}, {0.42, 0.5, 0.34});
    for (const double x : {-0.22, 0.0, 0.22})
      mesh.tube({{x, 0.4, x == 0 ? 0.14 : 0.03}, {x, kVault.spring - 0.2, x == 0 ? 0.14 : 0.03}}, 0.13, 12);
    mesh.box({-0.42, kVault.spring - 0.3, -0.1}, {0.42, kVault.spring, 0.36});
  }
  mesh.frame(glm::translate(glm::dmat4(1), {0, 0, z}));
  transverseArch(mesh, kVault, 0.42, 0.46);
}

void farWall(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::translate(glm::dmat4(1), {0, 0, kBack}));
  wall(mesh, p.stone, {-kHalfWidth - kWall, kHalfWidth + kWall, -0.2, kWallTop, -kWall, 0},
       roundOpening(kRound, kRoundRadius + 0.25, 48), roundOpening(kRound, kRoundRadius, 48), 50);
  mesh.material(p.rib).bar(atDepth(circleCurve(kRound, kRoundRadius + 0.32, 64), 0.03), {0, 0, 1}, 0.18, 0.18, true);
  const double z = -0.5 * kWall;
  const auto ring = [&](double radius) {
    mesh.bar(atDepth(circleCurve(kRound, radius, 48), z), {0, 0, 1}, 0.1, 0.16, true);
  };
  mesh.material(p.lead);
  ring(0.3 * kRoundRadius);
  ring(0.68 * kRoundRadius);
  for (int spoke = 0; spoke < 12; ++spoke) {
    const double angle = glm::two_pi<double>() * spoke / 12;
    const glm::dvec2 out(std::cos(angle), std::sin(angle));
    mesh.bar({{kRound + 0.3 * kRoundRadius * out, z}, {kRound + (kRoundRadius + 0.2) * out, z}}, {0, 0, 1}, 0.07, 0.12);
  }
  const double r = kRoundRadius + 0.3;
  const double out = -kWall - 0.05;
  mesh.material(p.daylight)
      .quad({kRound + glm::dvec2(-r, -r), out}, {kRound + glm::dvec2(r, -r), out}, {kRound + glm::dvec2(r, r), out},
            {kRound + glm::dvec2(-r, r), out});
}

/// Floor, roof and the wall behind the camera.
void shell(MeshBuilder& mesh, const Palette& p) {
  const double out = kHalfWidth + kWall;
  mesh.frame(glm::dmat4(1)).material(p.stone.tones[0]);
  mesh.box({-out, -0.6, kBack - kWall}, {out, -0.02, kFront + kWall});
  mesh.box({-out, kWallTop - 0.2, kBack - kWall}, {out, kWallTop + 0.4, kFront + kWall});
  mesh.frame(frameAt({0, 0, kFront}, {0, 1, 0}, {0, 0, -1}));
  wall(mesh, p.stone, {-out, out, -0.2, kWallTop, -kWall, 0}, 60);
  mesh.frame(glm::dmat4(1));
  constexpr int kAcross = 14;
  constexpr int kAlong = 20;
  const double x = 2 * kHalfWidth / kAcross;
  const double z = (kFront - kBack) / kAlong;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAlong; ++j) {
      const double left = -kHalfWidth + i * x;
      const double far = kBack + j * z;
      mesh.material((i + j) % 2 == 0 ? p.floorLight : p.floorDark);
      mesh.quad({left, 0, far + z}, {left + x, 0, far + z}, {left + x, 0, far}, {left, 0, far});
    }
}

/// The dais, the spindle and the ring that holds the armillary sphere.
void stand(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.rib);
  mesh.lathe({{1.7, 0}, {1.7, 0.16}, {1.4, 0.16}, {1.4, 0.32}, {1.1, 0.32}, {1.1, 0.44}, {0, 0.44}}, 64);
  mesh.material(p.darkBrass);
  mesh.lathe({{0.62, 0.44}, {0.60, 0.52}, {0.40, 0.58}, {0.24, 0.70}, {0.19, 0.86}, {0.17, 0.94}}, 48);
  mesh.lathe({{0.17, 0.94}, {0.17, kSpindleTop - 0.1}, {0.23, kSpindleTop - 0.06}, {0.08, kHeart - kMeridian}}, 48);
  mesh.material(p.brass).frame(glm::rotate(glm::translate(glm::dmat4(1), {0, kHeart, 0}), 0.5 * glm::pi<double>(),
                                           glm::normalize(glm::dvec3(1, 0, 0.35))));
  const double h = 0.05, in = kMeridian - 0.05;
  mesh.lathe({{in, h}, {in, -h}, {kMeridian, -h}, {kMeridian, h}, {in, h}}, 120);
}

Palette paint(Scene& scene) {
  Palette p;
  for (const double tone : {1.0, 0.84, 1.14, 0.93, 1.06})
    p.stone.tones.push_back(scene.add({"stone", tone * glm::dvec3(0.40, 0.34, 0.27)}));
  p.stone.length = 1.3;
  p.stone.height = 0.6;
  for (const double tone : {1.0, 0.9, 1.08})
    p.web.tones.push_back(scene.add({"vault", tone * glm::dvec3(0.44, 0.39, 0.33)}));
  p.rib = scene.add({"dressed stone", {0.50, 0.44, 0.35}});
  p.floorLight = scene.add({"pale marble", {0.46, 0.43, 0.38}});
  p.floorDark = scene.add({"dark marble", {0.13, 0.12, 0.12}});
  p.daylight = scene.add({"daylight", glm::dvec3(0), {0.62, 0.78, 1.0}});
  p.lead = scene.add({"lead", {0.10, 0.10, 0.11}});
  p.brass = scene.add({"brass", {0.72, 0.50, 0.18}});
  p.darkBrass = scene.add({"dark brass", {0.36, 0.24, 0.10}});
  p.steel = scene.add({"steel", {0.62, 0.63, 0.66}});
  p.copper = scene.add({"copper", {0.72, 0.33, 0.17}});
  p.gold = scene.add({"gold", {0.90, 0.64, 0.22}});
  p.lapis = scene.add({"lapis lazuli", {0.10, 0.19, 0.55}});
  p.ivory = scene.add({"ivory", {0.82, 0.76, 0.62}});
  p.jade = scene.add({"jade", {0.16, 0.48, 0.32}});
  p.ebony = scene.add({"ebony", {0.09, 0.07, 0.06}});
  return p;
}

} // namespace
} // namespace orrery

Scene makeOrrery() {
  using namespace orrery;
  Scene scene;
  scene.camera = {{-1.2, 3.6, 9.0}, {0.15, 3.15, -1.5}, 55, 0.1, 60};
  Light sun;
  sun.colour = {1.0, 0.86, 0.64};
  sun.intensity = 40;
  sun.direction = {0.80, -0.43, 0.14};
  scene.lights = {sun};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.020), 0.5}, {"isotropic", glm::dvec3(0.010), 0}};
  scene.absorption = glm::dvec3(0.001);
  scene.sky = {0.20, 0.195, 0.20};

  const Palette palette = paint(scene);
  MeshBuilder mesh(scene);
  shell(mesh, palette);
  farWall(mesh, palette);
  for (int bay = 0; bay < kBays; ++bay) {
    leftBay(mesh, palette, bay);
    rightBay(mesh, palette, bay);
    mesh.frame(glm::translate(glm::dmat4(1), {0, 0, bayCentre(bay)}));
    vault(mesh, palette.web, palette.rib, kVault, 70 + bay);
  }
  for (int index = 0; index <= kBays; ++index)
    line(mesh, palette, index);
  stand(mesh, palette);
  addBodies(scene, palette);
  return scene;
}

} // namespace scenes
