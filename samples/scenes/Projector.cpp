// A lantern lecture: a slide of coloured glass before a lamp, its picture on the screen and all along the beam.
#include "MeshBuilder.h"
#include "Scene.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scenes {
namespace {

const glm::dvec3 kLamp{1.9, 2.5, 4.6};
const glm::dvec3 kScreen{-0.4, 2.1, -5.9}; ///< its middle
constexpr double kSlideDistance = 0.4;     ///< from the lamp
constexpr double kSlideHalfWidth = 0.092;
constexpr double kSlideHalfHeight = 0.069;
constexpr int kColumns = 64;
constexpr int kRows = 48;

enum Pane { Night, Dusk, Rose, Gold, Sun, Hill, Wood, Water, Gleam, Sail, Hull, Panes };

const std::array<glm::dvec3, Panes> kColours = {{{0.03, 0.07, 0.55},
                                                 {0.16, 0.22, 0.75},
                                                 {0.80, 0.30, 0.42},
                                                 {0.98, 0.62, 0.18},
                                                 {1.00, 0.93, 0.62},
                                                 {0.30, 0.14, 0.52},
                                                 {0.05, 0.36, 0.16},
                                                 {0.02, 0.30, 0.58},
                                                 {0.90, 0.70, 0.40},
                                                 {0.98, 0.97, 0.92},
                                                 {0.35, 0.06, 0.04}}};

/// The slide's picture, x to the right and y upwards from 0 to 1: a boat on a lake at sunset.
Pane pictureAt(double x, double y) {
  constexpr double kShore = 0.36;
  const glm::dvec2 sun(0.64, 0.52);
  const double mast = x - 0.33;
  if (y > 0.27 && y < 0.62 && mast > -0.004 && mast < 0.17 * (0.62 - y) / 0.35) return Sail;
  if (y > 0.29 && y < 0.55 && mast <= -0.012 && mast > -0.1 * (0.55 - y) / 0.26) return Sail;
  if (y > 0.20 && y < 0.255 && std::abs(x - 0.34) < 0.10 + 0.7 * (y - 0.20)) return Hull;
  if (y < kShore) {
    const bool gleams =
        std::abs(x - sun.x) < 0.035 + 0.22 * (kShore - y) && std::sin(110 * y + 6 * std::sin(9 * x)) > 0.1;
    return gleams ? Gleam : Water;
  }
  if (y < kShore + 0.05 + 0.05 * std::sin(7 * x + 0.6) + 0.012 * std::sin(41 * x)) return Wood;
  if (y < kShore + 0.14 + 0.07 * std::sin(4.1 * x + 2.2) + 0.02 * std::sin(17 * x)) return Hill;
  const double toSun = glm::length((glm::dvec2(x, y) - sun) * glm::dvec2(4.0 / 3, 1));
  if (toSun < 0.085) return Sun;
  if (toSun < 0.20) return Gold;
  if (toSun < 0.34) return Rose;
  return y + 0.05 * std::sin(11 * x) < 0.84 ? Dusk : Night;
}

/// Along +y from the lamp, z upwards.
void slide(MeshBuilder& mesh, const std::array<int, Panes>& panes, int frame) {
  const auto corner = [](int column, int row) {
    return glm::dvec3(kSlideHalfWidth * (1 - 2.0 * column / kColumns), kSlideDistance,
                      kSlideHalfHeight * (2.0 * row / kRows - 1));
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const Pane pane = pictureAt((column + 0.5) / kColumns, (row + 0.5) / kRows);
      mesh.material(panes[pane])
          .quad(corner(column, row), corner(column + 1, row), corner(column + 1, row + 1), corner(column, row + 1));
    }
  const double w = kSlideHalfWidth, h = kSlideHalfHeight, out = 0.24, near = kSlideDistance - 0.01,
               far = kSlideDistance + 0.01;
  mesh.material(frame);
  mesh.box({-out, near, h}, {out, far, out});
  mesh.box({-out, near, -out}, {out, far, -h});
  mesh.box({-out, near, -h}, {-w, far, h});
  mesh.box({w, near, -h}, {out, far, h});
}

void lantern(MeshBuilder& mesh, int metal, int brass) {
  mesh.material(metal);
  const double r = 0.25;
  mesh.box({-r, -0.55, -r}, {r, -0.5, r}); // its back and sides; the front is the slide
  mesh.box({-r, -0.5, -r}, {-r + 0.012, kSlideDistance, r});
  mesh.box({r - 0.012, -0.5, -r}, {r, kSlideDistance, r});
  mesh.box({-r, -0.5, -r}, {r, kSlideDistance, -r + 0.012});
  mesh.box({-r, -0.5, r - 0.012}, {r, kSlideDistance, r});
  mesh.material(brass).torus({0, kSlideDistance + 0.03, 0}, 0.27, 0.018, 32, 10);
}

void room(MeshBuilder& mesh, int boards, int wall, int screen, int wood) {
  mesh.frame(glm::dmat4(1)).material(boards).box({-4.4, -0.2, -6.4}, {4.4, 0, 6.4});
  mesh.material(wall);
  mesh.box({-4.4, -0.1, -6.4}, {4.4, 4.6, -6.1});
  mesh.box({-4.4, -0.1, 6.1}, {4.4, 4.6, 6.4});
  mesh.box({-4.4, -0.1, -6.2}, {-4.1, 4.6, 6.2});
  mesh.box({4.1, -0.1, -6.2}, {4.4, 4.6, 6.2});
  mesh.box({-4.4, 4.4, -6.4}, {4.4, 4.7, 6.4});
  for (int i = 1; i < 7; ++i)
    mesh.material(wood).box({-4.2, 4.16, -5.4 + 1.8 * i - 0.11}, {4.2, 4.42, -5.4 + 1.8 * i + 0.11});
  mesh.material(screen).box(kScreen - glm::dvec3(2.5, 1.85, 0.06), kScreen + glm::dvec3(2.5, 1.85, 0));
  mesh.material(wood);
  mesh.box(kScreen + glm::dvec3(-2.6, 1.85, -0.08), kScreen + glm::dvec3(2.6, 1.95, 0.04));
  for (int row = 0; row < 4; ++row) { // benches
    const double z = -3.4 + 1.7 * row;
    mesh.box({-3.2, 0.42, z - 0.18}, {1.2, 0.47, z + 0.18});
    mesh.box({-3.2, 0.47, z + 0.15}, {1.2, 0.88, z + 0.19});
    for (const double x : {-3.0, -1.0, 1.0})
      mesh.box({x - 0.03, 0, z - 0.15}, {x + 0.03, 0.42, z + 0.15});
  }
  mesh.tube({{kLamp.x, 0, kLamp.z}, {kLamp.x, kLamp.y - 0.27, kLamp.z}}, 0.05, 12);
}

} // namespace

Scene makeProjector() {
  Scene scene;
  scene.camera = {{-3.3, 1.75, 5.3}, {0.25, 2.0, -2.4}, 58, 0.1, 40};
  Light lamp;
  lamp.kind = LightKind::Spot;
  lamp.name = "lantern";
  lamp.colour = {1.0, 0.95, 0.86};
  lamp.intensity = 420;
  lamp.position = kLamp;
  lamp.direction = kScreen - kLamp;
  lamp.innerConeAngle = 23;
  lamp.outerConeAngle = 25.5;
  scene.lights = {lamp};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.016), 0.4}, {"isotropic", glm::dvec3(0.012), 0}};
  scene.absorption = glm::dvec3(0.001);
  scene.sky = {0.16, 0.15, 0.17};

  std::array<int, Panes> panes{};
  for (std::size_t i = 0; i < panes.size(); ++i)
    panes[i] = scene.add({"slide glass " + std::to_string(i), kColours[i], glm::dvec3(0), true, true});
  const int boards = scene.add({"boards", {0.22, 0.14, 0.09}}), wall = scene.add({"wall", {0.20, 0.19, 0.21}});
  const int screen = scene.add({"screen", {0.86, 0.86, 0.84}}), wood = scene.add({"dark wood", {0.13, 0.08, 0.05}});
  const int metal = scene.add({"black steel", {0.05, 0.05, 0.055}}), brass = scene.add({"brass", {0.62, 0.45, 0.18}});
  MeshBuilder mesh(scene);
  room(mesh, boards, wall, screen, wood);
  mesh.frame(frameAt(kLamp, glm::normalize(kScreen - kLamp), {0, 1, 0}));
  slide(mesh, panes, metal);
  lantern(mesh, metal, brass);
  return scene;
}

} // namespace scenes
