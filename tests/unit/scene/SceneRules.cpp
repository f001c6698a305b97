#include "SceneRules.h"

#include <cmath>

namespace tests {

namespace {

/// The first rule that did not hold.
class Rules {
public:
  void require(bool holds, const char* rule) {
    if (!holds && broken_.empty()) broken_ = rule;
  }
  const std::string& broken() const { return broken_; }

private:
  std::string broken_;
};

bool isIndex(int index, std::size_t count) { return index >= -1 && index < static_cast<int>(count); }

template <typename Vector>
bool isFinite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i)
    if (!std::isfinite(v[i])) return false;
  return true;
}

template <typename Vector>
bool isRadiance(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i)
    if (!(v[i] >= 0)) return false;
  return isFinite(v);
}

void checkPrimitive(const host::Primitive& primitive, const host::Scene& scene, Rules& rules) {
  rules.require(primitive.material >= 0 && isIndex(primitive.material, scene.materials.size()), "material in range");
  for (const std::uint32_t index : primitive.indices)
    rules.require(index < primitive.vertices.size(), "index in range");
  for (const host::Vertex& vertex : primitive.vertices)
    rules.require(isFinite(vertex.position) && isFinite(vertex.normal) && isFinite(vertex.uv), "vertices are finite");
  const std::size_t corners = primitive.topology == host::Topology::Triangles ? 3
                              : primitive.topology == host::Topology::Lines   ? 2
                                                                              : 1;
  rules.require(primitive.indices.size() % corners == 0, "primitives are whole");
}

void checkLooks(const host::Scene& scene, Rules& rules) {
  rules.require(!scene.materials.empty(), "materials are never empty");
  for (const host::Material& material : scene.materials) {
    rules.require(isIndex(material.texture, scene.textures.size()), "texture in range");
    rules.require(isFinite(material.baseColour) && std::isfinite(material.alphaCutoff), "base colour is finite");
    rules.require(std::isfinite(material.transmission) && isRadiance(material.emission), "emission is a radiance");
  }
  for (const host::Texture& texture : scene.textures) {
    const auto texels = static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    rules.require(texels > 0 && texture.rgba.size() == 4 * texels, "texture is whole");
  }
}

void checkNodes(const host::Scene& scene, Rules& rules) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const host::Node& node = scene.nodes[i];
    rules.require(isIndex(node.parent, i) && isIndex(node.mesh, scene.meshes.size()), "parent and mesh in range");
    rules.require(isIndex(node.camera, scene.cameras.size()), "camera in range");
    rules.require(isIndex(node.light, scene.lights.size()), "light in range");
    const glm::dmat4 matrix = node.matrix.value_or(glm::dmat4(1));
    for (int column = 0; column < 4; ++column)
      rules.require(isFinite(matrix[column]), "matrix is finite");
    rules.require(isFinite(node.translation) && isFinite(node.scale) && std::isfinite(glm::length(node.rotation)),
                  "translation, rotation and scale are finite");
  }
}

void checkCamerasAndLights(const host::Scene& scene, Rules& rules) {
  for (const host::Camera& camera : scene.cameras) {
    rules.require(camera.verticalFov > 0 && camera.verticalFov < 3.1416 && camera.halfHeight > 0, "camera has a size");
    rules.require(camera.nearPlane >= 0 && (camera.farPlane == 0 || camera.farPlane > camera.nearPlane),
                  "camera has planes");
  }
  for (const host::Light& light : scene.lights) {
    rules.require(isRadiance(light.colour) && light.range > 0, "light has colour and range");
    rules.require(light.innerConeAngle >= 0 && light.innerConeAngle <= light.outerConeAngle, "light has cones");
  }
  for (const host::SmokeEmitter& smoke : scene.smoke)
    rules.require(isIndex(smoke.node, scene.nodes.size()) && smoke.node >= 0 && smoke.lifetime() > 0, "smoke lives");
  for (const host::FogBank& fog : scene.fog)
    rules.require(isIndex(fog.node, scene.nodes.size()) && fog.node >= 0 && fog.extinction >= 0 && fog.fade <= 1,
                  "fog has a place");
}

void checkAnimation(const host::Scene& scene, Rules& rules) {
  for (const host::AnimationChannel& channel : scene.animation) {
    const std::size_t values = channel.interpolation == host::Interpolation::CubicSpline ? 3 : 1;
    rules.require(channel.node >= 0 && isIndex(channel.node, scene.nodes.size()), "animated node in range");
    rules.require(!channel.times.empty() && channel.values.size() == values * channel.times.size(), "a value a key");
    for (std::size_t i = 1; i < channel.times.size(); ++i)
      rules.require(channel.times[i] > channel.times[i - 1], "times increase");
  }
  for (const double seconds : {-1.0, 0.0, 0.5, 1.5, 9.0})
    rules.require(host::poseAt(scene, seconds).size() == scene.nodes.size(), "a pose has all nodes");
}

} // namespace

std::string brokenRuleOf(const host::Scene& scene) {
  Rules rules;
  for (const host::Mesh& mesh : scene.meshes)
    for (const host::Primitive& primitive : mesh.primitives)
      checkPrimitive(primitive, scene, rules);
  checkLooks(scene, rules);
  checkNodes(scene, rules);
  checkCamerasAndLights(scene, rules);
  checkAnimation(scene, rules);
  return rules.broken();
}

} // namespace tests
