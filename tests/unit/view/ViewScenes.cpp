#include "ViewScenes.h"

#include <cmath>
#include <numeric>

namespace tests {

glm::dvec3 Dice::inBox(const glm::dvec3& low, const glm::dvec3& high) {
  const double x = between(low.x, high.x);
  const double y = between(low.y, high.y);
  return {x, y, between(low.z, high.z)};
}

glm::dvec3 Dice::direction() {
  const double z = between(-1, 1);
  const double angle = between(0, 2 * 3.14159265358979323846);
  const double radius = std::sqrt(1 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

host::Scene sceneOf(const std::vector<glm::vec3>& corners) {
  host::Primitive primitive;
  for (const glm::vec3& corner : corners) {
    host::Vertex vertex;
    vertex.position = corner;
    primitive.vertices.push_back(vertex);
  }
  primitive.indices.resize(corners.size());
  std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
  host::Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back({"mesh", {primitive}});
  scene.nodes.emplace_back();
  scene.nodes.back().mesh = 0;
  return scene;
}

host::Scene scatteredTriangles(std::uint32_t seed, int count, const glm::dvec3& low, const glm::dvec3& high,
                               double size) {
  Dice dice(seed);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 centre = dice.inBox(low, high);
    for (int k = 0; k < 3; ++k)
      corners.emplace_back(centre + size * dice.direction());
  }
  return sceneOf(corners);
}

std::vector<glm::vec3> quad(const glm::vec3& corner, const glm::vec3& side, const glm::vec3& otherSide) {
  return {corner, corner + side, corner + side + otherSide, corner, corner + side + otherSide, corner + otherSide};
}

std::vector<glm::vec3> box(const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 x(high.x - low.x, 0, 0);
  const glm::vec3 y(0, high.y - low.y, 0);
  const glm::vec3 z(0, 0, high.z - low.z);
  std::vector<glm::vec3> corners;
  for (const auto& side : {quad(low, y, x), quad(low, z, y), quad(low, x, z), quad(low + z, x, y), quad(low + x, y, z),
                           quad(low + y, z, x)})
    corners.insert(corners.end(), side.begin(), side.end());
  return corners;
}

Pose restPose(const host::Scene& scene) { return Pose(scene.nodes.size(), glm::dmat4(1)); }

} // namespace tests
