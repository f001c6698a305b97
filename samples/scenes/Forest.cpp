// The forest after the TREES scene of Chen et al. 2011: a clearing whose light comes through the crowns.
#include "Tree.h"

#include "Noise.h"
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

constexpr double kHalfGround = 52;
constexpr glm::dvec3 kEye(1, 0, 12);
constexpr glm::dvec3 kSun(0.44, -0.52, 0.73); ///< where its light travels to

struct Palette {
  Foliage broad;
  Foliage young;
  int soil = 0;
  int moss = 0;
  int rock = 0;
  std::vector<int> litter;
  int fern = 0;
  int grass = 0;
  int log = 0;
};

double groundAt(double x, double z) {
  const double distance = std::sqrt(x * x + z * z);
  const double bank = std::max(0.0, distance - 16);
  return 0.9 * fractal({0.07 * x + 3.1, 0.07 * z - 1.7}, 4, 5) + 0.0045 * bank * bank;
}

glm::dvec3 onGround(double x, double z) { return {x, groundAt(x, z), z}; }

/// Where no tree stands: the clearing and the way to it from the camera.
bool isOpen(double x, double z) {
  const glm::dvec2 clearing((x + 0.5) / 6.5, (z + 1.0) / 6.0);
  if (glm::dot(clearing, clearing) < 1) return true;
  const double path = std::abs(x - 1.3 - 0.1 * (z - 15));
  return z > 0 && z < 24 && path < 3.2;
}

void ground(MeshBuilder& mesh, const Palette& p) {
  mesh.material(p.soil).sheet(
      104, 104, [](double u, double v) { return onGround((2 * u - 1) * kHalfGround, (1 - 2 * v) * kHalfGround); });
}

std::vector<glm::dvec2> treePlaces(Random& random) {
  std::vector<glm::dvec2> places{{-4.6, 7.2}, {6.6, 5.0}, {-2.9, -8.2}, {3.9, -9.6}};
  for (int attempt = 0; attempt < 4000 && places.size() < 60; ++attempt) {
    const double radius = 33 * std::sqrt(random.unit());
    const double angle = random.between(0, glm::two_pi<double>());
    const glm::dvec2 place(radius * std::cos(angle), radius * std::sin(angle) - 5);
    if (isOpen(place.x, place.y) || glm::distance(place, {1.5, 15}) < 5) continue;
    bool free = true;
    for (const glm::dvec2& other : places)
      free = free && glm::distance(place, other) > 3.6;
    if (free) places.push_back(place);
  }
  return places;
}

/// The wood's far edge: tall and dense, lower towards the sun.
void edge(MeshBuilder& mesh, const Palette& p, Random& random) {
  constexpr int kTrees = 56;
  for (int i = 0; i < kTrees; ++i) {
    const double angle = glm::two_pi<double>() * (i + random.between(-0.3, 0.3)) / kTrees;
    const double radius = random.between(34, 41);
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    const double sunward = glm::dot(out, -glm::normalize(glm::dvec3(kSun.x, 0, kSun.z)));
    if (sunward < -0.75) continue;
    TreeShape shape;
    shape.height = random.between(19, 25) - (sunward > 0.85 ? 7 : 0);
    shape.crown = random.between(4.0, 5.0);
    shape.bare = 0.12;
    shape.radius = 0.28;
    shape.branches = 20;
    shape.twigs = 4;
    shape.leavesPerTwig = 6;
    shape.leafLength = 1.0;
    mesh.frame(glm::translate(glm::dmat4(1), onGround(radius * out.x, radius * out.z)));
    tree(mesh, p.broad, shape, random);
  }
  mesh.frame(glm::dmat4(1));
}

void trees(MeshBuilder& mesh, const Palette& p, Random& random) {
  for (const glm::dvec2& place : treePlaces(random)) {
    const double distance = glm::length(place);
    const bool isYoung = random.unit() < 0.25 && distance > 9;
    TreeShape shape;
    shape.height = isYoung ? random.between(6, 9) : random.between(14, 20);
    shape.crown = isYoung ? random.between(1.8, 2.4) : random.between(4.2, 5.6);
    shape.bare = isYoung ? 0.2 : random.between(0.32, 0.45);
    shape.radius = shape.height * random.between(0.015, 0.022);
    shape.branches = isYoung ? 11 : 17;
    shape.twigs = isYoung ? 5 : 8;
    shape.leavesPerTwig = distance > 30 ? 7 : 10;
    shape.leafLength = distance > 30 ? 0.75 : 0.56;
    mesh.frame(glm::translate(glm::dmat4(1), onGround(place.x, place.y)));
    tree(mesh, isYoung ? p.young : p.broad, shape, random);
  }
  mesh.frame(glm::dmat4(1));
}

void litter(MeshBuilder& mesh, const Palette& p, Random& random) {
  for (int i = 0; i < 7000; ++i) {
    const double radius = 26 * std::sqrt(random.unit());
    const double angle = random.between(0, glm::two_pi<double>());
    const double turn = random.between(0, glm::two_pi<double>());
    const glm::dvec3 stalk =
        onGround(radius * std::cos(angle), radius * std::sin(angle) + 4) + glm::dvec3(0, random.between(0.02, 0.07), 0);
    const glm::dvec3 along(std::cos(turn), random.between(-0.15, 0.25), std::sin(turn));
    mesh.material(p.litter[static_cast<std::size_t>(random.below(static_cast<int>(p.litter.size())))]);
    const glm::dvec3 across(-along.z, random.between(-0.3, 0.3), along.x);
    leaf(mesh, stalk, glm::normalize(along), across, random.between(0.1, 0.2));
  }
}

void grass(MeshBuilder& mesh, const Palette& p, Random& random) {
  mesh.material(p.grass);
  for (int i = 0; i < 9000; ++i) {
    const double x = random.between(-14, 14);
    const double z = random.between(-12, 16);
    if (fractal({0.22 * x, 0.22 * z}, 3, 61) < random.between(-0.1, 0.35)) continue;
    const double turn = random.between(0, glm::two_pi<double>());
    const glm::dvec3 side(std::cos(turn), 0, std::sin(turn));
    const double height = random.between(0.12, 0.34);
    const glm::dvec3 root = onGround(x, z) - glm::dvec3(0, 0.02, 0);
    const double sideways = random.between(-0.5, 0.5);
    const double forwards = random.between(-0.5, 0.5);
    const glm::dvec3 lean = height * glm::dvec3(sideways, 1, forwards);
    mesh.polygon({root - 0.012 * side, root + 0.012 * side, root + lean});
  }
}

void undergrowth(MeshBuilder& mesh, const Palette& p, Random& random) {
  for (int i = 0; i < 150; ++i) {
    const double radius = random.between(4, 22);
    const double angle = random.between(0, glm::two_pi<double>());
    const double x = radius * std::cos(angle);
    const double z = radius * std::sin(angle) + 1;
    if (std::abs(x - 1.3 - 0.1 * (z - 15)) < 1.6 && z > -4) continue;
    fern(mesh, p.fern, onGround(x, z), random.between(0.5, 1.0), random);
  }
  const glm::dvec2 stones[] = {{-3.4, 3.6}, {-2.5, 4.3}, {4.4, 0.6},  {5.3, 1.2},  {-5.8, -2.2},
                               {2.2, -6.2}, {7.6, 8.6},  {-7.3, 5.5}, {0.2, -7.4}, {9.5, -3.0}};
  for (const glm::dvec2& s : stones) {
    const double size = random.between(0.35, 0.95);
    mesh.material(random.unit() < 0.4 ? p.moss : p.rock)
        .boulder(onGround(s.x, s.y), {1.25 * size, 0.75 * size, size}, 0.28, s.x, 22);
  }
  std::vector<glm::dvec3> log;
  for (int i = 0; i <= 8; ++i)
    log.push_back(onGround(-4.4 + 0.62 * i, 1.3 - 0.34 * i) + glm::dvec3(0, 0.24, 0));
  mesh.material(p.log).tube(log, {0.36, 0.33, 0.32, 0.32, 0.3, 0.29, 0.27, 0.26, 0.24}, 12);
}

Palette paint(Scene& scene) {
  Palette p;
  const auto sheet = [&](const char* name, const glm::dvec3& colour) {
    return scene.add({name, colour, glm::dvec3(0), false, true});
  };
  p.broad.leaves = {sheet("leaf", {0.13, 0.24, 0.04}), sheet("dark leaf", {0.07, 0.16, 0.03}),
                    sheet("bright leaf", {0.22, 0.32, 0.06})};
  p.young.leaves = {sheet("young leaf", {0.24, 0.36, 0.07}), p.broad.leaves[0]};
  p.broad.bark = scene.add({"bark", {0.10, 0.072, 0.05}});
  p.young.bark = scene.add({"pale bark", {0.22, 0.19, 0.15}});
  p.soil = scene.add({"forest floor", {0.052, 0.047, 0.029}});
  p.moss = scene.add({"moss", {0.12, 0.18, 0.04}});
  p.rock = scene.add({"rock", {0.26, 0.25, 0.23}});
  p.litter = {sheet("brown litter", {0.24, 0.12, 0.04}), sheet("yellow litter", {0.38, 0.24, 0.07}),
              sheet("green litter", {0.16, 0.2, 0.05})};
  p.fern = sheet("fern", {0.14, 0.3, 0.05});
  p.grass = sheet("grass", {0.16, 0.26, 0.05});
  p.log = scene.add({"rotten wood", {0.14, 0.1, 0.06}});
  return p;
}

} // namespace

Scene makeForest() {
  Scene scene;
  const double eyeHeight = groundAt(kEye.x, kEye.z) + 1.6;
  scene.camera = {{kEye.x, eyeHeight, kEye.z}, {-2.6, eyeHeight + 3, 0}, 58, 0.1, 200};
  Light sun;
  sun.colour = {1.0, 0.86, 0.62};
  sun.intensity = 14;
  sun.direction = kSun;
  scene.lights = {sun};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.0046), 0.5}, {"isotropic", {0.0018, 0.0025, 0.0028}, 0}};
  scene.absorption = glm::dvec3(0.0006);
  scene.sky = {0.20, 0.30, 0.38};

  const Palette palette = paint(scene);
  MeshBuilder mesh(scene);
  Random random(20110218);
  ground(mesh, palette);
  trees(mesh, palette, random);
  edge(mesh, palette, random);
  litter(mesh, palette, random);
  grass(mesh, palette, random);
  undergrowth(mesh, palette, random);
  return scene;
}

} // namespace scenes
