// Three braziers before a stone wall, after figure 4 of Salvi et al. 2013: light from the side has each column of smoke
// shadow the next ones, the wall and the floor.
#include "Architecture.h"

#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

constexpr double kApart = 2.1; ///< from brazier to brazier
constexpr double kBowl = 0.95; ///< height of the coals

void room(MeshBuilder& mesh, Scene& scene) {
  Masonry stone;
  for (const double tone : {1.0, 0.86, 1.12, 0.94, 1.05})
    stone.tones.push_back(scene.add({"stone", tone * glm::dvec3(0.21, 0.20, 0.185)}));
  stone.length = 1.2;
  stone.height = 0.55;
  mesh.frame(glm::translate(glm::dmat4(1), {0, 0, -2.6}));
  wall(mesh, stone, {-11, 11, -0.2, 9, -0.5, 0}, 3);
  const int pale = scene.add({"pale slabs", {0.24, 0.225, 0.205}}),
            dark = scene.add({"dark slabs", {0.13, 0.125, 0.12}});
  mesh.frame(glm::dmat4(1));
  constexpr double kSlab = 0.75;
  for (int i = -12; i < 12; ++i)
    for (int j = -4; j < 10; ++j) {
      const double x = i * kSlab, z = j * kSlab;
      mesh.material((i + j) % 2 == 0 ? pale : dark);
      mesh.quad({x, 0, z + kSlab}, {x + kSlab, 0, z + kSlab}, {x + kSlab, 0, z}, {x, 0, z});
    }
}

void brazier(MeshBuilder& mesh, double x, int bronze, int coals) {
  mesh.frame(glm::translate(glm::dmat4(1), {x, 0, 0})).material(bronze);
  mesh.lathe({{0.34, 0}, {0.34, 0.05}, {0.12, 0.10}, {0.07, 0.22}, {0.10, 0.36}, {0.06, 0.5}, {0.09, 0.62}}, 40);
  mesh.lathe({{0.09, 0.62}, {0.30, 0.74}, {0.38, kBowl - 0.06}, {0.42, kBowl}, {0.38, kBowl}, {0.30, 0.84}, {0, 0.78}},
             40);
  mesh.torus({0, kBowl - 0.01, 0}, 0.41, 0.03, 64, 12);
  mesh.material(coals).lathe({{0.30, 0.84}, {0.22, 0.87}, {0.12, 0.88}, {0, 0.885}}, 24);
}

Smoke column(int index) {
  Smoke smoke;
  smoke.name = "smoke " + std::to_string(index);
  smoke.position = {(index - 1) * kApart, kBowl - 0.02, 0};
  smoke.particles = 620;
  smoke.radius = 0.12;
  smoke.growth = 3.6;
  smoke.density = 1.6;
  smoke.spread = 0.16;
  smoke.height = 4.8;
  smoke.rise = 0.7;
  smoke.drift = {0.04, 0, 0.02};
  smoke.turbulence = 1.0;
  smoke.albedo = {0.86, 0.87, 0.90};
  smoke.seed = 11 + index;
  return smoke;
}

} // namespace

Scene makeSmoke() {
  Scene scene;
  scene.camera = {{0.9, 2.0, 7.6}, {0.15, 2.25, -0.6}, 46, 0.1, 60};
  Light key;
  key.kind = LightKind::Spot;
  key.name = "key";
  key.colour = {1.0, 0.84, 0.62};
  key.intensity = 1500;
  key.position = {-7.6, 4.9, 3.4};
  key.direction = glm::dvec3(0.6, 1.9, -0.7) - key.position;
  key.innerConeAngle = 20;
  key.outerConeAngle = 27;
  scene.lights = {key};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.010), 0.4}, {"isotropic", glm::dvec3(0.006), 0}};
  scene.absorption = glm::dvec3(0.0005);
  scene.sky = {0.30, 0.36, 0.46};

  MeshBuilder mesh(scene);
  room(mesh, scene);
  const int bronze = scene.add({"bronze", {0.30, 0.19, 0.10}});
  const int coals = scene.add({"coals", {0.05, 0.03, 0.02}, {1.0, 0.30, 0.06}});
  for (int index = 0; index < 3; ++index) {
    brazier(mesh, (index - 1) * kApart, bronze, coals);
    scene.smoke.push_back(column(index));
  }
  return scene;
}

} // namespace scenes
