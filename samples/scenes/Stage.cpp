// A theatre after Yusov's (GDC 2013) spot lights: coloured beams cut by louvres, seen from the auditorium.
#include "Stage.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace stage {
namespace {

constexpr double kHalfWidth = 7.6; ///< of the stage house
constexpr double kBack = -7.4;     ///< its back wall
constexpr double kFront = 0.4;     ///< the stage's edge
constexpr double kCeiling = 8.6;
constexpr double kRear = 10.5; ///< the auditorium's rear wall

struct Lamp {
  const char* name;
  glm::dvec3 position;
  glm::dvec3 target;
  glm::dvec3 colour;
  double intensity;
  bool hasWheel;
};

const std::vector<Lamp> kLamps = {
    {"blue spot", {-4.6, 6.15, -5.6}, {1.6, 1.0, -1.9}, {0.18, 0.42, 1.0}, 1400, false},
    {"magenta spot", {4.6, 6.15, -5.6}, {-1.7, 1.0, -1.9}, {1.0, 0.22, 0.55}, 1500, false},
    {"amber spot", {-1.7, 6.15, -5.6}, {-2.9, 1.0, -2.6}, {1.0, 0.62, 0.22}, 1000, false},
    {"white spot", {1.5, 6.3, -1.3}, {0.3, 2.4, -4.6}, {0.85, 1.0, 0.95}, 900, true},
};

/// What a concert adds: six beams from behind, two from the front.
const std::vector<Lamp> kConcertLamps = {
    {"violet spot", {-5.7, 6.15, -5.6}, {-4.4, 1.0, -2.4}, {0.45, 0.16, 1.0}, 900, false},
    {"cyan spot", {-3.1, 6.15, -5.6}, {-0.4, 1.0, -2.2}, {0.10, 0.85, 1.0}, 900, true},
    {"green spot", {-0.4, 6.15, -5.6}, {2.6, 1.0, -2.4}, {0.20, 1.0, 0.35}, 800, false},
    {"red spot", {0.9, 6.15, -5.6}, {-1.0, 1.0, -3.0}, {1.0, 0.12, 0.08}, 1000, true},
    {"gold spot", {2.7, 6.15, -5.6}, {4.0, 1.0, -2.2}, {1.0, 0.75, 0.20}, 900, false},
    {"rose spot", {5.8, 6.15, -5.6}, {3.0, 1.0, -2.0}, {1.0, 0.35, 0.65}, 900, true},
    {"left front spot", {-4.2, 6.3, -1.3}, {-2.0, 1.6, -5.0}, {0.40, 0.60, 1.0}, 700, false},
    {"right front spot", {4.4, 6.3, -1.3}, {2.2, 1.6, -5.0}, {1.0, 0.55, 0.30}, 700, false},
};

std::vector<Lamp> lampsOf(bool concert) {
  std::vector<Lamp> lamps = kLamps;
  if (concert) lamps.insert(lamps.end(), kConcertLamps.begin(), kConcertLamps.end());
  return lamps;
}

void house(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.blackWall);
  const double out = kHalfWidth + 1.2;
  mesh.box({-out, -0.3, kBack - 0.4}, {out, 0, kRear + 0.4});
  mesh.box({-out, kCeiling, kBack - 0.4}, {out, kCeiling + 0.3, kRear + 0.4});
  mesh.box({-out, -0.1, kBack - 0.4}, {out, kCeiling + 0.1, kBack});
  mesh.box({-out, -0.1, kRear}, {out, kCeiling + 0.1, kRear + 0.4});
  for (const double side : {-1.0, 1.0}) {
    const double a = side * kHalfWidth;
    const double b = side * out;
    mesh.box({std::min(a, b), -0.1, kBack - 0.1}, {std::max(a, b), kCeiling + 0.1, kRear + 0.1});
  }
  mesh.material(p.wood).box({-kHalfWidth, -0.1, kBack}, {kHalfWidth, kFloor - 0.02, kFront});
  constexpr int kPlanks = 76;
  for (int i = 0; i < kPlanks; ++i) {
    const double left = -kHalfWidth + 2 * kHalfWidth * i / kPlanks;
    const double right = -kHalfWidth + 2 * kHalfWidth * (i + 1) / kPlanks;
    for (int k = 0; k < 4; ++k) {
      const double z = kFront + (kBack - kFront) * k / 4;
      const double next = kFront + (kBack - kFront) * (k + 1) / 4;
      mesh.material(p.planks.pick(i, k, 5))
          .quad({left, kFloor, z}, {right, kFloor, z}, {right, kFloor, next}, {left, kFloor, next});
    }
  }
}

/// The wall between stage and auditorium with a basket arch, its edge gilded.
void proscenium(MeshBuilder& mesh, const Palette& p) {
  Opening opening;
  const double half = 6.0;
  for (int i = 0; i <= 32; ++i) {
    const double u = -std::cos(glm::pi<double>() * i / 32);
    opening.x.push_back(half * u);
    opening.low.push_back(-0.1);
    opening.high.push_back(5.9 + 1.25 * std::sqrt(std::max(0.0, 1 - u * u)));
  }
  mesh.frame(frameAt({0, 0, kFront - 0.35}, {0, 1, 0}, {0, 0, 1}));
  wall(mesh, p.wall, {-kHalfWidth - 0.1, kHalfWidth + 0.1, -0.1, kCeiling + 0.1, -0.3, 0.3}, opening, opening, 3);
  std::vector<glm::dvec3> edge{{-half - 0.12, kFloor - 0.2, 0.33}};
  std::vector<glm::dvec3> outer{{-half - 0.4, kFloor - 0.2, 0.33}};
  for (std::size_t i = 0; i < opening.x.size(); ++i) {
    edge.emplace_back(opening.x[i] * 1.02, opening.high[i] + 0.1, 0.33);
    outer.emplace_back(opening.x[i] * 1.067, opening.high[i] + 0.36, 0.33);
  }
  edge.emplace_back(half + 0.12, kFloor - 0.2, 0.33);
  outer.emplace_back(half + 0.4, kFloor - 0.2, 0.33);
  mesh.material(p.gilding).tube(edge, 0.09, 10);
  mesh.tube(outer, 0.05, 8);
  for (int i = -9; i <= 9; ++i)
    mesh.box({i * 0.62 - 0.24, 0.25, kFront - 0.05 + 0.35}, {i * 0.62 + 0.24, 0.75, kFront + 0.06 + 0.35});
}

void curtain(MeshBuilder& mesh, double from, double to, double z, double bottom, double top, double gather) {
  const int folds = std::max(3, static_cast<int>(std::abs(to - from) / 0.34));
  mesh.sheet(folds * 8, 12, [&](double u, double v) {
    const double wave = std::sin(glm::two_pi<double>() * folds * u);
    const double tie = gather * std::sin(glm::pi<double>() * std::clamp(1.25 * v, 0.0, 1.0));
    const double x = from + (to - from) * u * (1 - tie);
    return glm::dvec3(x, bottom + (top - bottom) * v, z + (0.11 + 0.02 * std::sin(17 * u)) * wave);
  });
}

void drapery(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.curtain);
  curtain(mesh, -7.2, -4.9, -0.65, kFloor, 7.6, 0.35);
  curtain(mesh, 7.2, 4.9, -0.65, kFloor, 7.6, 0.35);
  curtain(mesh, -7.4, -5.6, -3.2, kFloor, 8.2, 0);
  curtain(mesh, 7.4, 5.6, -3.2, kFloor, 8.2, 0);
  mesh.material(p.backdrop);
  curtain(mesh, -7.5, 7.5, -7.0, kFloor, 8.3, 0);
  mesh.material(p.curtain);
  mesh.sheet(240, 6, [](double u, double v) {
    const double swag = 0.38 * std::abs(std::sin(glm::pi<double>() * 7 * u));
    return glm::dvec3(-6.6 + 13.2 * u, 7.7 - (1 - v) * (0.75 + swag),
                      -0.42 + 0.07 * std::sin(glm::two_pi<double>() * 40 * u));
  });
}

/// Around the light at the origin, which shines along +y.
void head(MeshBuilder& mesh, const Palette& p, const Lamp& lamp) {
  mesh.material(p.blackSteel);
  lampHousing(mesh);
  if (lamp.hasWheel)
    wheel(mesh, 0.42, 0.2, 10);
  else
    louvre(mesh, 0.42, 0.2, 6);
}

void trusses(MeshBuilder& mesh, const Palette& p) {
  mesh.frame(glm::dmat4(1)).material(p.steel);
  truss(mesh, {-7.0, 6.95, -5.75}, {7.0, 6.95, -5.75}, 0.42);
  truss(mesh, {-7.0, 7.05, -1.25}, {7.0, 7.05, -1.25}, 0.36);
  for (const double x : {-5.4, 5.4})
    truss(mesh, {x, kFloor, -6.3}, {x, 6.9, -6.3}, 0.36);
  for (const double x : {-5.0, 0.0, 5.0})
    for (const double z : {-5.75, -1.25})
      mesh.tube({{x, 7.1, z}, {x, kCeiling, z}}, 0.012, 6);
}

void rig(MeshBuilder& mesh, const Palette& p, const std::vector<Lamp>& lamps) {
  trusses(mesh, p);
  for (const Lamp& lamp : lamps) {
    const glm::dvec3 beam = glm::normalize(lamp.target - lamp.position);
    mesh.frame(frameAt(lamp.position, beam, {0, 0, 1}));
    head(mesh, p, lamp);
    mesh.frame(glm::dmat4(1)).tube({lamp.position - beam * 0.42, {lamp.position.x, 6.95, lamp.position.z}}, 0.022, 8);
  }
}

constexpr double kSweepSeconds = 5; ///< a loop of 120 frames
constexpr int kSweepSteps = 60;

/// What the i-th lamp is aimed at: neighbours go opposite ways, and no two are ever quite together.
glm::dvec3 sweptTarget(const Lamp& lamp, std::size_t i, double turn) {
  const double phase = glm::two_pi<double>() * (turn + 0.19 * static_cast<double>(i));
  const double way = i % 2 == 0 ? 1 : -1;
  return lamp.target + glm::dvec3(2.6 * way * std::sin(phase), 0.7 * std::sin(2 * phase), 0.5 * std::cos(phase));
}

Body turningHead(const Scene& scene, const Palette& p, const Lamp& lamp, std::size_t i) {
  Body body;
  body.name = lamp.name + std::string(" head");
  MeshBuilder mesh(scene, body);
  head(mesh, p, lamp);
  for (int step = 0; step <= kSweepSteps; ++step) {
    const double turn = static_cast<double>(step % kSweepSteps) / kSweepSteps;
    const glm::dmat3 aimed(frameAt(lamp.position, sweptTarget(lamp, i, turn) - lamp.position, {0, 0, 1}));
    body.poses.push_back({kSweepSeconds * step / kSweepSteps, lamp.position, glm::quat_cast(aimed)});
  }
  return body;
}

/// Heads that turn under the trusses, each with its light.
void turningRig(Scene& scene, MeshBuilder& mesh, const Palette& p, const std::vector<Lamp>& lamps) {
  trusses(mesh, p);
  mesh.material(p.blackSteel);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    mesh.tube({lamps[i].position + glm::dvec3(0, 0.35, 0), {lamps[i].position.x, 6.95, lamps[i].position.z}}, 0.022, 8);
    scene.lights[i].body = static_cast<int>(scene.bodies.size());
    scene.lights[i].position = glm::dvec3(0);
    scene.lights[i].direction = {0, 1, 0};
    scene.bodies.push_back(turningHead(scene, p, lamps[i], i));
  }
}

Palette paint(Scene& scene) {
  Palette p;
  for (const double tone : {0.85, 1.0, 1.15, 0.95})
    p.planks.tones.push_back(scene.add({"stage boards", tone * glm::dvec3(0.30, 0.19, 0.11)}));
  for (const double tone : {1.0, 1.12, 0.9})
    p.wall.tones.push_back(scene.add({"house wall", tone * glm::dvec3(0.24, 0.11, 0.08)}));
  p.wall.length = 1.4;
  p.wall.height = 0.7;
  p.blackWall = scene.add({"black wall", {0.05, 0.045, 0.05}});
  p.steel = scene.add({"steel", {0.42, 0.43, 0.45}});
  p.blackSteel = scene.add({"black steel", {0.05, 0.05, 0.055}});
  p.curtain = scene.add({"velvet", {0.40, 0.03, 0.04}, glm::dvec3(0), false, true});
  p.backdrop = scene.add({"backdrop", {0.12, 0.12, 0.16}, glm::dvec3(0), false, true});
  p.gilding = scene.add({"gilding", {0.68, 0.47, 0.16}});
  p.seat = scene.add({"seat", {0.16, 0.03, 0.03}});
  p.wood = scene.add({"dark wood", {0.14, 0.08, 0.05}});
  p.plaster = scene.add({"plaster", {0.72, 0.70, 0.66}});
  p.paper = scene.add({"paper", {0.8, 0.78, 0.7}});
  return p;
}

Scene makeHouse(const std::vector<Lamp>& lamps, bool turning) {
  Scene scene;
  scene.camera = {{1.2, 2.5, 7.6}, {-0.1, 3.45, -3.5}, 52, 0.1, 60};
  for (const Lamp& lamp : lamps) {
    Light spot;
    spot.kind = LightKind::Spot;
    spot.name = lamp.name;
    spot.colour = lamp.colour;
    spot.intensity = lamp.intensity;
    spot.position = lamp.position;
    spot.direction = lamp.target - lamp.position;
    spot.innerConeAngle = 15;
    spot.outerConeAngle = 21;
    scene.lights.push_back(spot);
  }
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.019), 0.5}, {"isotropic", glm::dvec3(0.017), 0}};
  scene.absorption = glm::dvec3(0.001);
  scene.sky = {0.085, 0.075, 0.095};

  const Palette palette = paint(scene);
  MeshBuilder mesh(scene);
  house(mesh, palette);
  proscenium(mesh, palette);
  drapery(mesh, palette);
  if (turning)
    turningRig(scene, mesh, palette, lamps);
  else
    rig(mesh, palette, lamps);
  props(mesh, palette);
  seats(mesh, palette);
  return scene;
}

} // namespace
} // namespace stage

Scene makeStage(bool concert) { return stage::makeHouse(stage::lampsOf(concert), false); }

Scene makeSweep() { return stage::makeHouse(stage::lampsOf(false), true); }

} // namespace scenes
