// A harbour at sundown: banks of fog on the water, shafts between the warehouses, lamps on the quay, a lighthouse.
#include "Architecture.h"
#include "Random.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace scenes {
namespace {

constexpr double kWater = -1.5, kQuay = 5; ///< height of the one, x of the other's edge

struct Paints {
  int water, stone, kerb, tar, hull, deck, cabin, iron, lampGlass, window, lit, white, red;
  std::vector<int> bricks;
};

Paints paintsOf(Scene& scene) {
  Paints p{};
  p.water = scene.add({"water", {0.018, 0.026, 0.032}});
  p.stone = scene.add({"quay", {0.20, 0.19, 0.175}});
  p.kerb = scene.add({"kerb", {0.29, 0.28, 0.26}});
  p.tar = scene.add({"roofs", {0.055, 0.05, 0.052}});
  p.hull = scene.add({"hull", {0.05, 0.085, 0.13}});
  p.deck = scene.add({"deck", {0.22, 0.16, 0.10}});
  p.cabin = scene.add({"cabin", {0.42, 0.40, 0.36}});
  p.iron = scene.add({"iron", {0.05, 0.052, 0.055}});
  p.lampGlass = scene.add({"lamp", {0.1, 0.09, 0.06}, {1.0, 0.78, 0.45}});
  p.window = scene.add({"window", {0.03, 0.035, 0.045}});
  p.lit = scene.add({"lit window", {0.1, 0.08, 0.05}, {0.95, 0.55, 0.22}});
  p.white = scene.add({"white", {0.62, 0.60, 0.57}});
  p.red = scene.add({"red", {0.36, 0.07, 0.05}});
  for (const glm::dvec3 brick : {glm::dvec3(0.20, 0.085, 0.06), {0.16, 0.075, 0.06}, {0.23, 0.15, 0.10}})
    p.bricks.push_back(scene.add({"bricks", brick}));
  return p;
}

void quay(MeshBuilder& mesh, const Paints& p) {
  mesh.frame(glm::dmat4(1)).material(p.water);
  mesh.quad({-160, kWater, 40}, {160, kWater, 40}, {160, kWater, -220}, {-160, kWater, -220});
  mesh.material(p.stone).box({kQuay, kWater - 1, -70}, {60, -0.18, 30});
  mesh.material(p.kerb);
  for (int i = 0; i < 50; ++i) {
    const double z = 29 - 2 * i;
    mesh.box({kQuay - 0.12, -0.18, z - 0.97}, {kQuay + 0.75, 0, z + 0.97});
  }
  mesh.material(p.stone).box({kQuay + 0.75, -0.18, -70}, {60, -0.03, 30});
  mesh.material(p.iron);
  for (int i = 0; i < 9; ++i) { // bollards
    mesh.frame(glm::translate(glm::dmat4(1), {kQuay + 0.35, 0, 11 - 6 * i}));
    mesh.lathe({{0.20, 0}, {0.15, 0.06}, {0.13, 0.34}, {0.21, 0.42}, {0.19, 0.50}, {0, 0.54}}, 20);
  }
  mesh.frame(glm::dmat4(1));
}

/// Gables along the quay with gaps that the sun comes through.
void warehouse(MeshBuilder& mesh, const Paints& p, int index, double near, double depth, double eaves) {
  constexpr double kFront = 10.5, kBack = 21;
  const double ridge = eaves + 3.4, middle = 0.5 * (kFront + kBack), far = near - depth;
  mesh.material(p.bricks[static_cast<std::size_t>(index) % p.bricks.size()]);
  mesh.prism({{kFront, -0.03}, {kBack, -0.03}, {kBack, eaves}, {middle, ridge}, {kFront, eaves}}, far, near);
  mesh.material(p.tar);
  for (const double side : {kFront, kBack}) {
    const double out = side < middle ? -0.45 : 0.45, drop = 0.45 * 3.4 / (middle - kFront);
    mesh.prism(side < middle ? std::vector<glm::dvec2>{{side + out, eaves - drop},
                                                       {middle, ridge},
                                                       {middle, ridge + 0.22},
                                                       {side + out, eaves - drop + 0.22}}
                             : std::vector<glm::dvec2>{{middle, ridge},
                                                       {side + out, eaves - drop},
                                                       {side + out, eaves - drop + 0.22},
                                                       {middle, ridge + 0.22}},
               far - 0.35, near + 0.35);
  }
  const int columns = static_cast<int>(depth / 2.2);
  for (int i = 0; i < columns; ++i)
    for (int floor = 0; floor < 2; ++floor) {
      const double z = near - (i + 0.5) * depth / columns, y = floor == 0 ? 1.0 : 3.6;
      const bool isLit = (index * 7 + i * 3 + floor * 5) % 11 == 0;
      mesh.material(isLit ? p.lit : p.window).box({kFront - 0.04, y, z - 0.45}, {kFront + 0.05, y + 1.5, z + 0.45});
      mesh.material(p.kerb).box({kFront - 0.12, y - 0.14, z - 0.6}, {kFront + 0.05, y, z + 0.6});
    }
}

void lamp(MeshBuilder& mesh, const Paints& p, const glm::dvec3& foot) {
  mesh.frame(glm::translate(glm::dmat4(1), foot)).material(p.iron);
  mesh.lathe({{0.17, 0}, {0.17, 0.1}, {0.09, 0.25}, {0.065, 0.6}, {0.05, 3.9}, {0.04, 4.35}}, 20);
  mesh.tube({{0, 4.2, 0}, {-0.25, 4.5, 0}, {-0.7, 4.6, 0}}, 0.035, 10);
  mesh.frame(glm::translate(glm::dmat4(1), foot + glm::dvec3(-0.7, 4.36, 0)));
  mesh.lathe({{0.28, 0.03}, {0.20, 0.16}, {0.07, 0.25}, {0, 0.27}}, 24);
  mesh.material(p.lampGlass).lathe({{0.14, 0}, {0.16, 0.02}, {0, 0.03}}, 20);
  mesh.frame(glm::dmat4(1));
}

/// A trawler along z, its bow to the viewer.
void ship(MeshBuilder& mesh, const Paints& p) {
  constexpr double kHalf = 7, kBeam = 2.1;
  mesh.frame(glm::translate(glm::dmat4(1), {2.2, kWater, -9.5}));
  const auto beam = [](double t) { return kBeam * std::pow(std::max(1 - std::pow(std::abs(t), 3.0), 0.0), 0.6); };
  const auto sheer = [](double t) { return 1.55 + 0.75 * t * t * (t > 0 ? 1.25 : 0.55); };
  const auto hull = [&](double u, double v) { // u from stern to bow, v from one rail under the keel to the other
    const double t = 2 * u - 1, angle = glm::pi<double>() * v, round = std::pow(std::sin(angle), 0.6);
    return glm::dvec3(-beam(t) * std::cos(angle), sheer(t) * (1 - round) - 0.5 * round,
                      kHalf * t + 0.5 * t * (1 - round));
  };
  mesh.material(p.hull).sheet(56, 24, [&](double u, double v) { return hull(u, 1 - v); });
  mesh.material(p.deck).sheet(56, 2, [&](double u, double v) {
    const double t = 2 * u - 1;
    return glm::dvec3((2 * v - 1) * 0.98 * beam(t), sheer(t) - 0.28, kHalf * t);
  });
  mesh.material(p.white);
  for (const double side : {-1.0, 1.0}) {
    std::vector<glm::dvec3> rail;
    for (int i = 1; i < 40; ++i) {
      const double t = 2 * (i / 40.0) - 1;
      rail.emplace_back(side * beam(t), sheer(t), kHalf * t + 0.5 * t);
    }
    mesh.tube(rail, 0.06, 8);
  }
  mesh.material(p.cabin).box({-1.15, 1.2, -4.6}, {1.15, 3.3, -1.4});
  mesh.box({-0.95, 3.3, -4.2}, {0.95, 4.7, -2.2});
  mesh.material(p.tar).box({-1.1, 4.7, -4.35}, {1.1, 4.82, -1.95});
  mesh.material(p.lit);
  for (int i = 0; i < 3; ++i) {
    const double x = -0.75 + 0.5 * i;
    mesh.box({x, 3.75, -2.22}, {x + 0.36, 4.4, -2.17});
  }
  mesh.material(p.red).tube({{0, 4.6, -3.8}, {0, 6.0, -3.9}}, 0.32, 16);
  mesh.material(p.iron).tube({{0, 1.4, 2.2}, {0, 9.2, 2.0}}, 0.11, 10);
  mesh.tube({{0, 4.7, -2.6}, {0, 7.8, -2.7}}, 0.08, 10);
  mesh.tube({{0, 2.1, 2.1}, {0.2, 6.4, -1.6}}, 0.08, 8);
  mesh.tube({{-1.3, 7.0, 2.05}, {1.3, 7.0, 2.05}}, 0.05, 8);
  for (const glm::dvec3 foot :
       {glm::dvec3(1.8, 1.7, 0.6), {-1.8, 1.7, 0.6}, {0, 2.9, 7.2}, {1.3, 1.9, 3.6}, {-1.3, 1.9, 3.6}})
    mesh.tube({{0, 8.9, 2.0}, foot}, 0.018, 6);
  mesh.tube({{0, 8.9, 2.0}, {0, 7.7, -2.7}}, 0.018, 6);
  for (int i = -1; i <= 1; ++i) // fenders
    mesh.frame(glm::translate(glm::dmat4(1), {2.2 + kBeam + 0.12, kWater + 1.1, -9.5 + 2.4 * i}))
        .sphere({0, 0, 0}, 0.24, 16);
  mesh.frame(glm::dmat4(1));
}

/// A lattice crane with its jib over the water.
void crane(MeshBuilder& mesh, const Paints& p) {
  mesh.frame(glm::translate(glm::dmat4(1), {7.4, 0, -20})).material(p.iron);
  constexpr double kTop = 13;
  const auto corner = [](int i, double y) {
    const double half = 1.1 - 0.5 * y / kTop;
    return glm::dvec3(i == 0 || i == 3 ? -half : half, y, i < 2 ? -half : half);
  };
  for (int i = 0; i < 4; ++i) {
    mesh.tube({corner(i, 0), corner(i, kTop)}, 0.085, 8);
    for (int k = 0; k < 7; ++k) {
      const double low = kTop * k / 7, high = kTop * (k + 1) / 7;
      mesh.tube({corner(i, low), corner((i + 1) % 4, high)}, 0.035, 6);
      mesh.tube({corner(i, high), corner((i + 1) % 4, high)}, 0.035, 6);
    }
  }
  mesh.material(p.red).box({-0.9, kTop, -0.9}, {1.6, kTop + 1.7, 0.9});
  mesh.material(p.iron);
  const glm::dvec3 root(-0.6, kTop + 0.9, 0), tip(-11.5, kTop + 5.2, 1.2);
  for (const double side : {-0.35, 0.35})
    for (const double up : {0.0, 0.8})
      mesh.tube({root + glm::dvec3(0, up, side), tip}, 0.055, 8);
  for (int k = 0; k < 9; ++k) {
    const glm::dvec3 a = glm::mix(root, tip, k / 9.0), b = glm::mix(root, tip, (k + 1) / 9.0);
    const double wide = 0.35 * (1 - k / 9.0), high = 0.8 * (1 - k / 9.0);
    mesh.tube({a + glm::dvec3(0, high, -wide), b + glm::dvec3(0, 0, -0.35 * (1 - (k + 1) / 9.0))}, 0.03, 6);
    mesh.tube({a + glm::dvec3(0, 0, wide), a + glm::dvec3(0, high, wide)}, 0.03, 6);
  }
  mesh.tube({tip, tip - glm::dvec3(0, 9.5, 0)}, 0.025, 6);
  mesh.tube({glm::dvec3(1.2, kTop + 4.4, 0), tip}, 0.03, 6);
  mesh.tube({glm::dvec3(0.2, kTop + 1.7, 0), glm::dvec3(1.2, kTop + 4.4, 0)}, 0.07, 8);
  mesh.frame(glm::dmat4(1));
}

const glm::dvec3 kLighthouse{-19, kWater, -58};
constexpr double kLantern = 13.2; ///< above the water

void lighthouse(MeshBuilder& mesh, const Paints& p) {
  Random random(5);
  mesh.frame(glm::translate(glm::dmat4(1), kLighthouse)).material(p.stone);
  for (int i = 0; i < 26; ++i) {
    const double angle = random.between(0, glm::two_pi<double>());
    const double r = random.between(2.5, 7);
    const double size = random.between(0.9, 2.2);
    mesh.boulder({r * std::cos(angle), 0.1, r * std::sin(angle)}, {size, 0.8 * size, size}, 0.3, i, 14);
  }
  mesh.material(p.white).lathe({{2.0, 0}, {1.9, 1.0}, {1.72, 4}}, 40);
  mesh.material(p.red).lathe({{1.72, 4}, {1.56, 7}}, 40);
  mesh.material(p.white).lathe({{1.56, 7}, {1.40, 10}, {1.36, 11.6}}, 40);
  mesh.material(p.iron).lathe({{1.36, 11.6}, {2.0, 11.8}, {2.0, 11.95}, {1.0, 12.0}, {1.0, 12.4}}, 40);
  mesh.lathe({{1.15, 14.0}, {0.95, 14.4}, {0.15, 15.2}, {0.1, 15.9}, {0, 16}}, 32);
  for (int i = 0; i < 8; ++i) {
    const double angle = glm::two_pi<double>() * i / 8;
    const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
    mesh.tube({out + glm::dvec3(0, 12.3, 0), out + glm::dvec3(0, 14.1, 0)}, 0.05, 6);
  }
  mesh.material(p.lampGlass).sphere({0, kLantern, 0}, 0.35, 24);
  mesh.frame(glm::dmat4(1));
}

Fog bank(const char* name, const glm::dvec3& position, const glm::dvec3& halfSize, double extinction,
         const glm::ivec3& billows, double clear, int seed) {
  Fog fog;
  fog.name = name;
  fog.position = position;
  fog.halfSize = halfSize;
  fog.extinction = extinction;
  fog.fade = 0.45;
  fog.billows = billows;
  fog.clear = clear;
  fog.seed = seed;
  return fog;
}

Light lampLight(const char* name, const glm::dvec3& foot) {
  Light light;
  light.kind = LightKind::Spot;
  light.name = name;
  light.colour = {1.0, 0.70, 0.36};
  light.intensity = 26;
  light.position = foot + glm::dvec3(-0.7, 4.3, 0);
  light.direction = {-0.12, -1, 0};
  light.innerConeAngle = 42;
  light.outerConeAngle = 64;
  return light;
}

} // namespace

Scene makeHarbour() {
  Scene scene;
  scene.camera = {{-4.6, 1.5, 12.5}, {1.9, 2.9, -12}, 52, 0.1, 320};
  const Paints paints = paintsOf(scene);
  MeshBuilder mesh(scene);
  quay(mesh, paints);
  const double eaves[] = {6.4, 5.6, 7.0, 6.0, 6.6};
  double near = 9;
  for (int i = 0; i < 5; ++i) {
    const double depth = i % 2 == 0 ? 9.5 : 8;
    warehouse(mesh, paints, i, near, depth, eaves[i]);
    near -= depth + 4.2;
  }
  const glm::dvec3 lamps[] = {{kQuay + 1.0, 0, 0.5}, {kQuay + 1.0, 0, -15}};
  for (const glm::dvec3& foot : lamps)
    lamp(mesh, paints, foot);
  ship(mesh, paints);
  crane(mesh, paints);
  lighthouse(mesh, paints);

  Light sun;
  sun.colour = {1.0, 0.52, 0.24};
  sun.intensity = 5.2;
  sun.direction = {-0.93, -0.31, 0.13};
  Light beam;
  beam.kind = LightKind::Spot;
  beam.name = "lighthouse";
  beam.colour = {0.92, 0.96, 1.0};
  beam.intensity = 9000;
  beam.position = kLighthouse + glm::dvec3(0, kLantern, 0) + glm::dvec3(1.1, 0, 0.5);
  beam.direction = {1, -0.16, 0.5};
  beam.innerConeAngle = 3.2;
  beam.outerConeAngle = 4.6;
  scene.lights = {sun, lampLight("lamp 1", lamps[0]), lampLight("lamp 2", lamps[1]), beam};

  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.0016, 0.0018, 0.0021), 0.65}};
  scene.absorption = glm::dvec3(0.0002);
  scene.farDistance = 300;
  scene.sky = {0.20, 0.205, 0.27};
  scene.ambient = {0.16, 0.17, 0.24};
  scene.fogAlbedo = {0.95, 0.95, 0.96};
  scene.fogG = 0.55;
  scene.fog = {bank("on the water", {-9, 0.4, -12}, {26, 2.6, 26}, 0.055, {10, 2, 10}, 0.35, 3),
               bank("around the ship", {0.8, 0.5, -9}, {9, 2.6, 9}, 0.11, {6, 2, 6}, 0.3, 11),
               bank("on the quay", {9.5, 1.1, -8}, {7, 1.9, 20}, 0.075, {4, 1, 10}, 0.3, 21),
               bank("beyond", {-6, 5, -52}, {46, 11, 20}, 0.04, {12, 3, 5}, 0.3, 31)};
  return scene;
}

} // namespace scenes
