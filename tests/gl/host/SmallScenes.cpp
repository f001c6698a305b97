#include "gl/host/SmallScenes.h"

#include "gl/Gl.h"

#include <cmath>

namespace tests {

host::Scene emptyScene() {
  host::Scene scene;
  scene.materials.emplace_back();
  return scene;
}

int addMaterial(host::Scene& scene, const host::Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

void addQuad(host::Scene& scene, const glm::dvec3& centre, const glm::vec3& halfU, const glm::vec3& halfV,
             int material) {
  host::Primitive primitive;
  primitive.material = material;
  const glm::vec3 normal = glm::normalize(glm::cross(halfU, halfV));
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    primitive.vertices.push_back({(2 * uv.x - 1) * halfU + (2 * uv.y - 1) * halfV, normal, uv});
  }
  primitive.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back({"quad", {primitive}});
  host::Node node;
  node.translation = centre;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.nodes.push_back(node);
}

void addWall(host::Scene& scene, double z, float halfSide, int material, const glm::dvec2& centre) {
  addQuad(scene, {centre, z}, {halfSide, 0, 0}, {0, halfSide, 0}, material);
}

std::vector<glm::dmat4> restPose(const host::Scene& scene) {
  std::vector<glm::dmat4> worldFromNode;
  for (const host::Node& node : scene.nodes) {
    glm::dmat4 matrix(1);
    matrix[3] = glm::dvec4(node.translation, 1);
    worldFromNode.push_back(matrix);
  }
  return worldFromNode;
}

tyndall::Camera cameraAtOrigin(const glm::dmat4& clipFromView, tyndall::ClipDepth clipDepth) {
  tyndall::Camera camera;
  camera.clipFromView = host::toMat4(clipFromView);
  camera.clipDepth = clipDepth;
  return camera;
}

tyndall::Light sunAlongZ(double halfWidth, double nearZ, double farZ, const host::ClipConvention& convention) {
  tyndall::Light light;
  light.direction = {0, 0, -1};
  light.shadow.clipDepth = convention.clipDepth;
  light.shadow.views = {{host::toMat4(host::orthographic(halfWidth, halfWidth, -nearZ, -farZ, convention)), 0}};
  return light;
}

tyndall::Light spotAtOrigin(double nearPlane, double farPlane, const host::ClipConvention& convention) {
  tyndall::Light light;
  light.kind = tyndall::LightKind::Spot;
  light.direction = {0, 0, -1};
  light.shadow.clipDepth = convention.clipDepth;
  light.shadow.views = {{host::toMat4(host::perspective(1, 1, nearPlane, farPlane, convention)), 0}};
  return light;
}

double depthAt(const glm::dmat4& clipFromView, tyndall::ClipDepth clipDepth, double distance) {
  const glm::dvec4 clip = clipFromView * glm::dvec4(0, 0, -distance, 1);
  const double ndc = clip.z / clip.w;
  return clipDepth == tyndall::ClipDepth::ZeroToOne ? ndc : 0.5 * ndc + 0.5;
}

bool supports(const host::ClipConvention& convention) {
  return convention.clipDepth == tyndall::ClipDepth::NegativeOneToOne || host::gl().ClipControl;
}

std::vector<host::ClipConvention> allConventions() {
  std::vector<host::ClipConvention> conventions;
  for (const bool reversed : {false, true}) {
    for (const tyndall::ClipDepth clipDepth : {tyndall::ClipDepth::NegativeOneToOne, tyndall::ClipDepth::ZeroToOne}) {
      conventions.push_back({reversed, clipDepth});
    }
  }
  return conventions;
}

std::string nameOf(const host::ClipConvention& convention) {
  return std::string(convention.reversed ? "reversed" : "standard") +
         (convention.clipDepth == tyndall::ClipDepth::ZeroToOne ? ", [0, 1]" : ", [-1, 1]");
}

} // namespace tests
