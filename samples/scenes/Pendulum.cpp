// The nave with a great brass pendulum that swings through its shafts: little moves, and what does casts long shadows.
#include "MeshBuilder.h"
#include "Scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

namespace scenes {
namespace {

const glm::dvec3 kPivot{-1.2, 11.5, 3.2};
constexpr double kLength = 7.4;
constexpr double kAngle = 0.24;   ///< radians, to either side
constexpr double kSeconds = 12.5; ///< two swings to and fro
constexpr int kSteps = 100;

void bob(MeshBuilder& mesh, int brass, int steel) {
  mesh.material(steel).tube({{0, 0, 0}, {0, -kLength + 0.6, 0}}, 0.025, 8);
  mesh.material(brass);
  mesh.sphere({0, -kLength, 0}, 0.62, 64);
  mesh.lathe({{0.0, -kLength - 0.95}, {0.05, -kLength - 0.85}, {0.16, -kLength - 0.55}, {0.0, -kLength - 0.5}}, 32);
  mesh.torus({0, -kLength, 0}, 0.63, 0.05, 64, 12);
}

} // namespace

Scene makePendulum() {
  Scene scene = makeNave(false);
  const int brass = scene.add({"pendulum brass", {0.62, 0.45, 0.18}});
  const int steel = scene.add({"pendulum wire", {0.3, 0.3, 0.32}});
  Body body;
  body.name = "pendulum";
  MeshBuilder mesh(scene, body);
  bob(mesh, brass, steel);
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = i == kSteps ? 0 : kAngle * std::sin(2 * glm::two_pi<double>() * i / kSteps);
    body.poses.push_back(
        {kSeconds * i / kSteps, kPivot, glm::angleAxis(angle, glm::normalize(glm::dvec3(0.35, 0, 1)))});
  }
  scene.bodies.push_back(std::move(body));
  return scene;
}

} // namespace scenes
