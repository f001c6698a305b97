// A model of the user's on a turntable in a box with one lamp: the set-up in which Lin et al. (2013) measure reuse.
#include "MeshBuilder.h"
#include "Scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <scene/GltfLoader.h>
#include <stdexcept>

namespace scenes {
namespace {

constexpr double kHeight = 1.5, kWidth = 2.4; ///< that the model fits into
constexpr double kTable = 0.5;
constexpr double kSeconds = 12.5; ///< of a full turn

void box(MeshBuilder& mesh, int wall, int left, int right) {
  mesh.material(wall);
  mesh.box({-3.2, -0.2, -3.2}, {3.2, 0, 3.8});
  mesh.box({-3.2, 4, -3.2}, {3.2, 4.2, 3.8});
  mesh.box({-3.2, 0, -3.2}, {3.2, 4, -3});
  mesh.box({-3.2, 0, 3.6}, {3.2, 4, 3.8});
  mesh.material(left).box({-3.2, 0, -3}, {-3, 4, 3.6});
  mesh.material(right).box({3, 0, -3}, {3.2, 4, 3.6});
}

/// The triangles of a scene in its first pose, scaled to stand on the origin.
Surface surfaceOf(const host::Scene& model) {
  const std::vector<glm::dmat4> pose = host::poseAt(model, 0);
  const host::Bounds bounds = host::boundsOf(model, pose);
  const glm::dvec3 size = bounds.high - bounds.low;
  const double across = std::hypot(size.x, size.z);
  const double scale = std::min(kHeight / std::max(size.y, 1e-9), kWidth / std::max(across, 1e-9));
  const glm::dvec3 foot(0.5 * (bounds.low.x + bounds.high.x), bounds.low.y, 0.5 * (bounds.low.z + bounds.high.z));
  Surface surface;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].mesh < 0) continue;
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(pose[n])));
    for (const host::Primitive& primitive : model.meshes[static_cast<std::size_t>(model.nodes[n].mesh)].primitives) {
      if (primitive.topology != host::Topology::Triangles) continue;
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      for (const host::Vertex& vertex : primitive.vertices) {
        surface.positions.push_back(scale * (glm::dvec3(pose[n] * glm::dvec4(vertex.position, 1)) - foot));
        const glm::dvec3 normal = normals * glm::dvec3(vertex.normal);
        surface.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::dvec3(0, 1, 0));
      }
      for (const std::uint32_t index : primitive.indices)
        surface.indices.push_back(first + index);
    }
  }
  if (surface.indices.empty()) throw std::runtime_error("the model has no triangles");
  return surface;
}

std::vector<Pose> fullTurn() {
  constexpr int kSteps = 12;
  std::vector<Pose> poses;
  for (int i = 0; i <= kSteps; ++i)
    poses.push_back({kSeconds * i / kSteps,
                     {0, kTable, 0},
                     i == kSteps ? glm::dquat(1, 0, 0, 0)
                                 : glm::angleAxis(glm::two_pi<double>() * i / kSteps, glm::dvec3(0, 1, 0))});
  return poses;
}

} // namespace

Scene makeTurntable(const std::string& path) {
  Scene scene;
  scene.camera = {{0, 1.9, 3.4}, {0, 1.35, 0}, 62, 0.1, 20};
  Light lamp;
  lamp.kind = LightKind::Spot;
  lamp.name = "lamp";
  lamp.intensity = 60;
  lamp.position = {-2.2, 3.7, -1.4};
  lamp.direction = glm::dvec3(0, 0.9, 0.1) - lamp.position;
  lamp.innerConeAngle = 26;
  lamp.outerConeAngle = 36;
  scene.lights = {lamp};
  scene.constituents = {{"henyey-greenstein", glm::dvec3(0.05), 0.3}, {"isotropic", glm::dvec3(0.02), 0}};
  scene.absorption = glm::dvec3(0.002);
  scene.sky = {0.12, 0.12, 0.13};
  const int wall = scene.add({"wall", {0.55, 0.54, 0.52}}), left = scene.add({"left wall", {0.45, 0.16, 0.12}});
  const int right = scene.add({"right wall", {0.14, 0.30, 0.20}}), table = scene.add({"table", {0.25, 0.2, 0.16}});
  const int clay = scene.add({"model", {0.72, 0.70, 0.66}});
  MeshBuilder mesh(scene);
  box(mesh, wall, left, right);
  mesh.material(table).lathe(
      {{0.0, 0.0}, {0.8, 0.0}, {0.7, 0.1}, {0.7, kTable - 0.1}, {1.3, kTable - 0.04}, {1.3, kTable}, {0.0, kTable}},
      48);
  Body body;
  body.name = "model";
  body.surfaces.resize(scene.materials.size());
  body.surfaces[static_cast<std::size_t>(clay)] = surfaceOf(host::loadScene(path));
  body.poses = fullTurn();
  scene.bodies.push_back(std::move(body));
  return scene;
}

} // namespace scenes
