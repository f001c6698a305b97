// The orrery's armillary sphere, its arms and the solids that tumble at their ends.
//
// Nothing meets: each arm keeps to a shell of radii of its own around the spindle, and the arms of outer shells pass
// below those of inner ones.
#include "Orrery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes::orrery {
namespace {

constexpr double kTwoPi = glm::two_pi<double>();
constexpr double kGolden = 1.6180339887498949;
constexpr double kFrameRate = 24;
constexpr int kFrames = 300;      ///< of the animation, which then begins again
constexpr double kForkGap = 0.05; ///< between a tumbling solid and the fork around it
constexpr double kForkThickness = 0.024;

glm::dquat turnAbout(const glm::dvec3& axis, double turns) { return glm::angleAxis(kTwoPi * turns, axis); }

/// One pose a frame; `poseAt` takes the share of the animation that has passed.
std::vector<Pose> posesOf(const std::function<Pose(double)>& poseAt) {
  std::vector<Pose> poses;
  for (int frame = 0; frame <= kFrames; ++frame) {
    poses.push_back(poseAt(static_cast<double>(frame % kFrames) / kFrames));
    poses.back().seconds = frame / kFrameRate;
  }
  return poses;
}

// ---------------------------------------------------------------------------------------------------------------------
// Solids around the origin

using Points = std::vector<glm::dvec3>;

Points octahedron() { return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}; }

/// (0, +-a, +-b) and its cyclic permutations.
Points goldenRectangles(double a, double b) {
  Points points;
  for (const double s : {-a, a})
    for (const double t : {-b, b})
      points.insert(points.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
  return points;
}

Points icosahedron() { return goldenRectangles(1, kGolden); }

Points dodecahedron() {
  Points points = goldenRectangles(1 / kGolden, kGolden);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        points.emplace_back(x, y, z);
  return points;
}

/// Puts the corners of a regular solid on a sphere; returns the length of its edges.
double scaleTo(Points& corners, double radius) {
  double edge = 2 * radius;
  for (glm::dvec3& corner : corners) {
    corner = radius * glm::normalize(corner);
    if (&corner != &corners.front()) edge = std::min(edge, glm::distance(corner, corners.front()));
  }
  return edge;
}

bool areJoined(const glm::dvec3& a, const glm::dvec3& b, double edge) {
  return std::abs(glm::distance(a, b) - edge) < 1e-6;
}

/// A regular solid whose faces are triangles.
void faceted(MeshBuilder& mesh, Points corners, double radius) {
  const double edge = scaleTo(corners, radius);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        const glm::dvec3 &a = corners[i], &b = corners[j], &c = corners[k];
        if (!areJoined(a, b, edge) || !areJoined(b, c, edge) || !areJoined(c, a, edge)) continue;
        const bool isOutward = glm::dot(glm::cross(b - a, c - a), a) > 0;
        mesh.polygon(isOutward ? Points{a, b, c} : Points{a, c, b});
      }
}

/// The edges of a regular solid as rods.
void openwork(MeshBuilder& mesh, Points corners, double radius, double thickness) {
  const double edge = scaleTo(corners, radius - 1.5 * thickness);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    mesh.sphere(corners[i], 1.5 * thickness, 16);
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if (areJoined(corners[i], corners[j], edge)) mesh.tube({corners[i], corners[j]}, thickness, 10);
  }
}

/// A square slab across z with `cells` x `cells` round holes.
void perforated(MeshBuilder& mesh, double half, double thickness, int cells, double hole) {
  constexpr int kSides = 32;
  const double cell = half / cells;
  const double z = 0.5 * thickness;
  std::array<glm::dvec2, kSides> round;
  std::array<glm::dvec2, kSides> square;
  for (int k = 0; k < kSides; ++k) {
    const glm::dvec2 out(std::cos(kTwoPi * k / kSides), std::sin(kTwoPi * k / kSides));
    round[static_cast<std::size_t>(k)] = hole * cell * out;
    square[static_cast<std::size_t>(k)] = cell * out / std::max(std::abs(out.x), std::abs(out.y));
  }
  for (int i = 0; i < cells * cells; ++i) {
    const glm::dvec2 centre = cell * (2.0 * glm::dvec2(i % cells, i / cells) + 1.0 - double(cells));
    for (std::size_t k = 0; k < kSides; ++k) {
      const std::size_t next = (k + 1) % kSides;
      const glm::dvec2 a = centre + round[k], b = centre + square[k], c = centre + square[next],
                       d = centre + round[next];
      mesh.quad({a, z}, {b, z}, {c, z}, {d, z});
      mesh.quad({d, -z}, {c, -z}, {b, -z}, {a, -z});
      mesh.quad({a, -z}, {a, z}, {d, z}, {d, -z});
    }
  }
  const std::array<glm::dvec2, 4> rim = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const glm::dvec2 a = rim[k], b = rim[(k + 1) % rim.size()];
    mesh.quad({a, -z}, {b, -z}, {b, z}, {a, z});
  }
}

/// A trefoil knot of fluted rope, finer than any pixel: 528 000 triangles. Its middle line lies on a torus, whose
/// normal is across it everywhere.
void knot(MeshBuilder& mesh, const Palette& p, double radius) {
  constexpr int kAlong = 1200;
  constexpr int kAround = 220;
  const double ring = 0.585 * radius, tube = 0.265 * radius, rope = 0.128 * radius;
  mesh.material(p.gold).sheet(kAlong, kAround, [&](double u, double v) {
    const double turn = u < 1 ? kTwoPi * u : 0;
    const double theta = 2 * turn, phi = 3 * turn;
    const glm::dvec3 out(std::cos(theta), 0, std::sin(theta)), along(-std::sin(theta), 0, std::cos(theta));
    const glm::dvec3 up(0, 1, 0);
    const glm::dvec3 normal = std::cos(phi) * out + std::sin(phi) * up;
    const glm::dvec3 tangent = glm::normalize(2 * (ring + tube * std::cos(phi)) * along +
                                              3 * tube * (std::cos(phi) * up - std::sin(phi) * out));
    const double angle = v < 1 ? kTwoPi * v : 0;
    const double flute = rope * (1 + 0.16 * std::cos(6 * angle + 36 * turn));
    return ring * out + tube * normal +
           flute * (std::cos(angle) * normal + std::sin(angle) * glm::cross(normal, tangent));
  });
}

void copperOctahedron(MeshBuilder& mesh, const Palette& p, double radius) {
  faceted(mesh.material(p.copper), octahedron(), radius);
}

void jadeIcosahedron(MeshBuilder& mesh, const Palette& p, double radius) {
  faceted(mesh.material(p.jade), icosahedron(), radius);
}

void openDodecahedron(MeshBuilder& mesh, const Palette& p, double radius) {
  openwork(mesh.material(p.steel), dodecahedron(), radius, 0.055 * radius);
}

void perforatedSlab(MeshBuilder& mesh, const Palette& p, double radius) {
  mesh.material(p.ebony).frame(glm::rotate(glm::dmat4(1), 0.5 * glm::pi<double>(), {0, 1, 0}));
  perforated(mesh, 0.697 * radius, 0.1 * radius, 3, 0.78);
}

void lapisMoon(MeshBuilder& mesh, const Palette& p, double radius) {
  mesh.material(p.lapis).boulder(glm::dvec3(0), glm::dvec3(0.92 * radius), 0.05, 3, 96);
}

void ringedPlanet(MeshBuilder& mesh, const Palette& p, double radius) {
  mesh.material(p.ivory).sphere(glm::dvec3(0), 0.52 * radius, 96);
  mesh.frame(glm::rotate(glm::dmat4(1), 0.5, {1, 0, 0}));
  const double h = 0.018 * radius;
  for (const glm::dvec2 ring : {glm::dvec2(0.64, 0.80), glm::dvec2(0.83, 0.99)}) {
    const double in = ring.x * radius, out = ring.y * radius;
    mesh.material(p.brass).lathe({{in, h}, {in, -h}, {out, -h}, {out, h}, {in, h}}, 96);
  }
  mesh.frame(glm::dmat4(1));
}

// ---------------------------------------------------------------------------------------------------------------------
// Arms

/// A solid in a fork at an arm's end; it turns about the fork's axis, which lies along the arm's way.
struct Tumbler {
  const char* name;
  double angle;  ///< around the arm, turns
  double height; ///< of its middle
  double radius; ///< of the sphere around it
  int turns;     ///< about the fork's axis, an animation
  void (*build)(MeshBuilder&, const Palette&, double radius);
};

struct Arm {
  const char* name;
  double height;
  double reach; ///< from the spindle to the tumblers
  int turns;    ///< about the spindle, an animation
  std::vector<Tumbler> tumblers;
};

/// The arm's rods with a half ring on each around its solid, the arm's angle 0 along x.
void buildArm(MeshBuilder& mesh, const Palette& p, const Arm& arm) {
  mesh.material(p.brass).frame(glm::dmat4(1));
  mesh.lathe({{0.15, -0.09}, {0.24, -0.09}, {0.27, -0.04}, {0.27, 0.04}, {0.24, 0.09}, {0.15, 0.09}}, 48);
  for (const Tumbler& tumbler : arm.tumblers) {
    mesh.frame(glm::rotate(glm::dmat4(1), kTwoPi * tumbler.angle, {0, 1, 0}));
    const double middle = tumbler.height - arm.height;
    const double fork = tumbler.radius + kForkGap;
    mesh.material(p.brass).tube({{0.2, 0, 0}, {arm.reach, 0, 0}}, 0.035, 16);
    mesh.tube({{arm.reach, 0, 0}, {arm.reach, middle - fork, 0}}, 0.028, 16);
    mesh.sphere({arm.reach, 0, 0}, 0.065, 24);
    mesh.sphere({arm.reach, middle - fork, 0}, 0.05, 24);
    Points half;
    for (int i = 0; i <= 48; ++i) {
      const double angle = -glm::pi<double>() * i / 48;
      half.emplace_back(arm.reach, middle + fork * std::sin(angle), fork * std::cos(angle));
    }
    mesh.material(p.darkBrass).tube(half, kForkThickness, 12);
    for (const double side : {-1.0, 1.0}) {
      mesh.sphere({arm.reach, middle, side * fork}, 0.045, 20);
      mesh.tube({{arm.reach, middle, side * fork}, {arm.reach, middle, 0.45 * side * fork}}, 0.012, 10);
    }
  }
}

void addArm(Scene& scene, const Palette& p, const Arm& arm) {
  Body rods;
  rods.name = arm.name;
  MeshBuilder mesh(scene, rods);
  buildArm(mesh, p, arm);
  rods.poses = posesOf([&](double t) { return Pose{0, {0, arm.height, 0}, turnAbout({0, 1, 0}, arm.turns * t)}; });
  scene.bodies.push_back(std::move(rods));
  for (const Tumbler& tumbler : arm.tumblers) {
    Body solid;
    solid.name = tumbler.name;
    MeshBuilder builder(scene, solid);
    tumbler.build(builder, p, tumbler.radius);
    solid.poses = posesOf([&](double t) {
      const glm::dquat around = turnAbout({0, 1, 0}, arm.turns * t + tumbler.angle);
      return Pose{0, around * glm::dvec3(arm.reach, tumbler.height, 0),
                  around * turnAbout({0, 0, 1}, tumbler.turns * t)};
    });
    scene.bodies.push_back(std::move(solid));
  }
}

std::vector<Arm> arms() {
  const Tumbler octahedron{"octahedron", 0, 3.0, 0.40, 3, copperOctahedron};
  const Tumbler moon{"moon", 0.5, 2.55, 0.38, 1, lapisMoon};
  const Tumbler rope{"knot", 0.02, 3.2, 0.72, 2, knot};
  const Tumbler dodecahedron{"dodecahedron", 0.36, 4.0, 0.70, -2, openDodecahedron};
  const Tumbler planet{"ringed planet", 0.68, 2.7, 0.70, 1, ringedPlanet};
  const Tumbler slab{"slab", 0.20, 3.5, 0.76, 3, perforatedSlab};
  const Tumbler icosahedron{"icosahedron", 0.66, 2.7, 0.70, -2, jadeIcosahedron};
  return {{"inner arm", 1.75, 1.92, 2, {octahedron, moon}},
          {"middle arm", 1.42, 3.22, 1, {rope, dodecahedron, planet}},
          {"outer arm", 1.09, 4.86, -1, {slab, icosahedron}}};
}

// ---------------------------------------------------------------------------------------------------------------------
// The armillary sphere

/// Its pole leans as the Earth's does.
glm::dquat leaning() { return glm::angleAxis(glm::radians(23.4), glm::normalize(glm::dvec3(0.35, 0, -1))); }

void addShell(Scene& scene, const char* name, int turns, const std::function<void(MeshBuilder&)>& build) {
  Body body;
  body.name = name;
  MeshBuilder mesh(scene, body);
  build(mesh);
  body.poses = posesOf([&](double t) { return Pose{0, {0, kHeart, 0}, leaning() * turnAbout({0, 1, 0}, turns * t)}; });
  scene.bodies.push_back(std::move(body));
}

/// A flat hoop about the frame's y.
void hoop(MeshBuilder& mesh, double radius, double height, double thickness) {
  const double in = radius - thickness, h = 0.5 * height;
  mesh.lathe({{in, h}, {in, -h}, {radius, -h}, {radius, h}, {in, h}}, 120);
}

void outerRings(MeshBuilder& mesh, const Palette& p) {
  const double r = kMeridian - 0.1;
  mesh.material(p.brass);
  hoop(mesh, r, 0.10, 0.03);
  for (const double side : {-1.0, 1.0}) {
    const double tropic = glm::radians(23.4 * side);
    mesh.frame(glm::translate(glm::dmat4(1), {0, r * std::sin(tropic), 0}));
    hoop(mesh, r * std::cos(tropic), 0.05, 0.025);
  }
  for (const double turn : {0.0, 0.25}) { // the colures, through the poles
    const glm::dmat4 aside = glm::rotate(glm::dmat4(1), kTwoPi * turn, {0, 1, 0});
    mesh.frame(glm::rotate(aside, 0.5 * glm::pi<double>(), {1, 0, 0}));
    hoop(mesh, r + 0.002, 0.06, 0.03);
  }
  mesh.material(p.darkBrass).frame(glm::rotate(glm::dmat4(1), glm::radians(23.4), {1, 0, 0}));
  hoop(mesh, r - 0.035, 0.2, 0.02); // the ecliptic
  mesh.material(p.steel).frame(glm::dmat4(1)).tube({{0, -kMeridian, 0}, {0, kMeridian, 0}}, 0.016, 12);
}

void innerRings(MeshBuilder& mesh, const Palette& p) {
  mesh.material(p.gold).sphere(glm::dvec3(0), 0.40, 96);
  mesh.material(p.copper);
  for (const double turn : {0.0, 1.0 / 3, 2.0 / 3}) {
    const glm::dmat4 aside = glm::rotate(glm::dmat4(1), kTwoPi * turn, {0, 1, 0});
    mesh.frame(glm::rotate(aside, glm::radians(62.0), {1, 0, 0}));
    mesh.torus(glm::dvec3(0), 0.86 - 0.05 * turn * 3, 0.024, 12, 120);
  }
  mesh.frame(glm::dmat4(1));
}

} // namespace

void addBodies(Scene& scene, const Palette& p) {
  addShell(scene, "outer rings", 1, [&](MeshBuilder& mesh) { outerRings(mesh, p); });
  addShell(scene, "inner rings", -2, [&](MeshBuilder& mesh) { innerRings(mesh, p); });
  for (const Arm& arm : arms())
    addArm(scene, p, arm);
}

} // namespace scenes::orrery
