// The glazed nave with a censer on a long chain, whose smoke drifts through the coloured shafts.
#include "MeshBuilder.h"
#include "Scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

const glm::dvec3 kCenser{-0.9, 2.6, 4.4};
constexpr double kHook = 15.4;

void censer(MeshBuilder& mesh, int gold, int coals) {
  mesh.frame(glm::translate(glm::dmat4(1), kCenser)).material(gold);
  mesh.lathe({{0.10, -0.34}, {0.13, -0.31}, {0.05, -0.27}, {0.16, -0.22}, {0.25, -0.10}, {0.27, 0}, {0.24, 0.02}}, 40);
  mesh.lathe({{0.25, 0.10}, {0.22, 0.20}, {0.13, 0.31}, {0.05, 0.36}, {0.04, 0.44}, {0, 0.47}}, 40);
  mesh.torus({0, 0.01, 0}, 0.26, 0.02, 40, 10);
  mesh.torus({0, 0.11, 0}, 0.25, 0.016, 40, 10);
  for (int i = 0; i < 6; ++i) { // the openings that smoke leaves by are between these
    const double angle = glm::two_pi<double>() * i / 6;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    mesh.tube({0.245 * out, 0.245 * out + glm::dvec3(0, 0.12, 0)}, 0.012, 8);
    if (i % 2 == 0) mesh.tube({0.27 * out, 0.05 * out + glm::dvec3(0, 1.3, 0)}, 0.008, 6);
  }
  mesh.torus({0, 1.32, 0}, 0.06, 0.012, 24, 8);
  mesh.tube({{0, 1.32, 0}, {0, kHook - kCenser.y, 0}}, 0.012, 6);
  mesh.material(coals).lathe({{0.2, 0.01}, {0.1, 0.05}, {0, 0.06}}, 24);
  mesh.frame(glm::dmat4(1));
}

/// Rises through the shaft of the window that the censer hangs before.
Smoke incense() {
  Smoke smoke;
  smoke.name = "incense";
  smoke.position = kCenser + glm::dvec3(0, 0.06, 0);
  smoke.particles = 520;
  smoke.radius = 0.17;
  smoke.growth = 5;
  smoke.density = 1.35;
  smoke.spread = 0.12;
  smoke.height = 7.0;
  smoke.rise = 0.85;
  smoke.drift = {0.05, 0, -0.10};
  smoke.turbulence = 1.5;
  smoke.albedo = {0.92, 0.92, 0.93};
  smoke.seed = 3;
  return smoke;
}

/// What has drifted off, through the next shafts towards the altar.
Smoke haze() {
  Smoke smoke;
  smoke.name = "haze";
  smoke.position = kCenser + glm::dvec3(-0.2, 3.0, -2.0);
  smoke.particles = 260;
  smoke.radius = 0.5;
  smoke.growth = 3;
  smoke.density = 0.33;
  smoke.spread = 0.45;
  smoke.height = 2.2;
  smoke.rise = 0.18;
  smoke.drift = {-0.04, 0, -0.95};
  smoke.turbulence = 1.6;
  smoke.albedo = {0.92, 0.92, 0.93};
  smoke.seed = 8;
  return smoke;
}

} // namespace

Scene makeCenser() {
  Scene scene = makeNave(true);
  scene.camera = {{2.9, 1.7, 12.6}, {-1.35, 5.2, -2.0}, 60, 0.1, 120};
  const int gold = scene.add({"censer", {0.75, 0.52, 0.15}});
  const int coals = scene.add({"coals", {0.05, 0.03, 0.02}, {1.0, 0.30, 0.06}});
  MeshBuilder mesh(scene);
  censer(mesh, gold, coals);
  scene.smoke = {incense(), haze()};
  scene.isSmokeLit = true;
  scene.fogAlbedo = glm::dvec3(0.92, 0.92, 0.93);
  scene.fogG = 0.4;
  scene.ambient = glm::dvec3(0.02, 0.0195, 0.019);
  return scene;
}

} // namespace scenes
