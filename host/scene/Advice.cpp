#include <scene/Advice.h>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <scene/Projection.h>
#include <scene/WorldGeometry.h>

namespace host {

namespace {

glm::dvec3 eyeOf(const tyndall::Camera& camera) { return glm::dvec3(glm::inverse(fromMat4(camera.viewFromWorld))[3]); }

/// The triangles of a node that stop light.
struct Caster {
  int node = 0;
  WorldGeometry geometry;
};

std::vector<Caster> castersAround(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                                  const glm::dvec3& eye) {
  std::vector<Caster> casters;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    Caster caster{static_cast<int>(node), opaqueGeometry(scene, worldFromNode, static_cast<int>(node))};
    glm::bvec3 above(false), below(false);
    for (const glm::dvec3& point : caster.geometry.points)
      for (int axis = 0; axis < 3; ++axis) {
        above[axis] = above[axis] || point[axis] > eye[axis];
        below[axis] = below[axis] || point[axis] < eye[axis];
      }
    if (glm::all(above) && glm::all(below)) casters.push_back(std::move(caster));
  }
  return casters;
}

/// Whether every ray from the eye, in 26 directions, ends at a surface, and the caster stands between the light and all
/// that was tried of these rays.
bool keepsOut(const WorldGeometry& caster, const WorldGeometry& all, const glm::dvec3& eye, const glm::dvec3& toLight) {
  for (int direction = 0; direction < 27; ++direction) {
    const glm::dvec3 offset(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
    if (offset == glm::dvec3(0)) continue;
    const glm::dvec3 along = glm::normalize(offset);
    auto end = firstHit(caster, eye, along);
    if (!end) end = firstHit(all, eye, along);
    if (!end) return false;
    for (const double share : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95})
      if (!firstHit(caster, eye + share * end->distance * along, toLight)) return false;
  }
  return true;
}

std::string nameOf(const Scene& scene, int node) {
  const Node& owner = scene.nodes[static_cast<std::size_t>(node)];
  const std::string& mesh = scene.meshes[static_cast<std::size_t>(owner.mesh)].name;
  return fmt::format("mesh \"{}\" of node {} \"{}\"", mesh, node, owner.name);
}

} // namespace

std::vector<Enclosure> enclosuresOf(const Scene& scene, const std::vector<glm::dmat4>& worldFromNode,
                                    const tyndall::Camera& camera, const std::vector<tyndall::Light>& lights) {
  std::vector<Enclosure> enclosures;
  const glm::dvec3 eye = eyeOf(camera);
  const std::vector<Caster> casters = castersAround(scene, worldFromNode, eye);
  if (casters.empty()) return enclosures;
  const WorldGeometry all = worldGeometry(scene, worldFromNode);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].kind != tyndall::LightKind::Directional) continue;
    const glm::dvec3 toLight = -glm::dvec3(lights[i].direction[0], lights[i].direction[1], lights[i].direction[2]);
    for (const Caster& caster : casters)
      if (keepsOut(caster.geometry, all, eye, toLight))
        enclosures.push_back({nameOf(scene, caster.node), static_cast<int>(i)});
  }
  return enclosures;
}

} // namespace host
