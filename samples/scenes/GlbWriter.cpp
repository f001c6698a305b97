#include "GlbWriter.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <tiny_gltf.h>

namespace scenes {
namespace {

constexpr const char* kLights = "KHR_lights_punctual";
constexpr const char* kTransmission = "KHR_materials_transmission";

std::vector<double> listOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

tinygltf::Value valueOf(const glm::dvec3& v) {
  return tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(v.x), tinygltf::Value(v.y), tinygltf::Value(v.z)});
}

template <class T>
int appendView(tinygltf::Model& model, const std::vector<T>& items, int target) {
  auto& bytes = model.buffers[0].data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = items.size() * sizeof(T);
  view.target = target;
  bytes.resize(bytes.size() + view.byteLength);
  std::memcpy(bytes.data() + view.byteOffset, items.data(), view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int appendVectors(tinygltf::Model& model, const std::vector<glm::dvec3>& vectors, bool withBounds) {
  std::vector<glm::vec3> packed;
  packed.reserve(vectors.size());
  glm::vec3 low(vectors.front());
  glm::vec3 high = low;
  for (const glm::dvec3& v : vectors) {
    packed.emplace_back(v);
    low = glm::min(low, packed.back());
    high = glm::max(high, packed.back());
  }
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, packed, TINYGLTF_TARGET_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_VEC3;
  accessor.count = packed.size();
  if (withBounds) {
    accessor.minValues = listOf(low);
    accessor.maxValues = listOf(high);
  }
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

int appendIndices(tinygltf::Model& model, const std::vector<std::uint32_t>& indices) {
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = indices.size();
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

tinygltf::Material materialOf(const Material& source) {
  tinygltf::Material material;
  material.name = source.name;
  material.pbrMetallicRoughness.baseColorFactor = {source.colour.r, source.colour.g, source.colour.b, 1};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.emissiveFactor = listOf(source.emission);
  material.alphaMode = "OPAQUE";
  material.doubleSided = source.doubleSided;
  if (source.glass)
    material.extensions[kTransmission] =
        tinygltf::Value(tinygltf::Value::Object{{"transmissionFactor", tinygltf::Value(1.0)}});
  return material;
}

bool isUsed(const Scene& scene, std::size_t material) {
  const auto hasIt = [&](const std::vector<Surface>& surfaces) {
    return material < surfaces.size() && !surfaces[material].indices.empty();
  };
  return hasIt(scene.surfaces) ||
         std::any_of(scene.strands.begin(), scene.strands.end(),
                     [&](const Strands& strands) { return strands.material == static_cast<int>(material); }) ||
         std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) { return hasIt(body.surfaces); });
}

/// Appends the materials that are in use; returns the index in the file of each of the scene's, -1 without one.
std::vector<int> appendMaterials(tinygltf::Model& model, const Scene& scene) {
  std::vector<int> indices(scene.materials.size(), -1);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!isUsed(scene, i)) continue;
    indices[i] = static_cast<int>(model.materials.size());
    model.materials.push_back(materialOf(scene.materials[i]));
    if (scene.materials[i].glass) model.extensionsUsed = {kTransmission};
  }
  return indices;
}

int appendMesh(tinygltf::Model& model, const std::string& name, const std::vector<Surface>& surfaces,
               const std::vector<int>& materials) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (surface.indices.empty()) continue;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = materials[i];
    primitive.attributes["POSITION"] = appendVectors(model, surface.positions, true);
    primitive.attributes["NORMAL"] = appendVectors(model, surface.normals, false);
    primitive.indices = appendIndices(model, surface.indices);
    mesh.primitives.push_back(primitive);
  }
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

int appendNode(tinygltf::Model& model, tinygltf::Node node) {
  model.nodes.push_back(std::move(node));
  const int index = static_cast<int>(model.nodes.size()) - 1;
  model.scenes[0].nodes.push_back(index);
  return index;
}

int appendMeshNode(tinygltf::Model& model, const std::string& name, int mesh) {
  tinygltf::Node node;
  node.name = name;
  node.mesh = mesh;
  return appendNode(model, node);
}

/// Appends `values`, those of one key after another, and the channel that plays them.
void appendChannel(tinygltf::Model& model, int node, const char* path, int times, int type,
                   const std::vector<float>& values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, values, 0);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = type;
  accessor.count = values.size() / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(type));
  model.accessors.push_back(accessor);
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = static_cast<int>(model.accessors.size()) - 1;
  sampler.interpolation = "LINEAR";
  tinygltf::Animation& animation = model.animations[0];
  animation.samplers.push_back(sampler);
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(channel);
}

void appendMotion(tinygltf::Model& model, int node, const std::vector<Pose>& poses) {
  std::vector<float> times;
  std::vector<float> translations;
  std::vector<float> rotations;
  for (const Pose& pose : poses) {
    times.push_back(static_cast<float>(pose.seconds));
    const glm::vec3 t(pose.translation);
    translations.insert(translations.end(), {t.x, t.y, t.z});
    const glm::quat q(pose.rotation);
    rotations.insert(rotations.end(), {q.x, q.y, q.z, q.w});
  }
  tinygltf::Accessor accessor;
  accessor.bufferView = appendView(model, times, 0);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = times.size();
  accessor.minValues = {times.front()};
  accessor.maxValues = {times.back()};
  model.accessors.push_back(accessor);
  const int input = static_cast<int>(model.accessors.size()) - 1;
  appendChannel(model, node, "translation", input, TINYGLTF_TYPE_VEC3, translations);
  appendChannel(model, node, "rotation", input, TINYGLTF_TYPE_VEC4, rotations);
}

void appendBodies(tinygltf::Model& model, const Scene& scene, const std::vector<int>& materials) {
  if (scene.bodies.empty()) return;
  model.animations.resize(1);
  model.animations[0].name = scene.name;
  for (const Body& body : scene.bodies) {
    const int node = appendMeshNode(model, body.name, appendMesh(model, body.name, body.surfaces, materials));
    appendMotion(model, node, body.poses);
  }
}

tinygltf::Value tyndallExtras(const char* name, tinygltf::Value::Object fields) {
  const tinygltf::Value::Object tyndall{{name, tinygltf::Value(std::move(fields))}};
  return tinygltf::Value(tinygltf::Value::Object{{"tyndall", tinygltf::Value(tyndall)}});
}

void appendStrands(tinygltf::Model& model, const Strands& strands, const std::vector<int>& materials) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_LINE;
  primitive.material = materials[static_cast<std::size_t>(strands.material)];
  primitive.attributes["POSITION"] = appendVectors(model, strands.points, true);
  primitive.indices = appendIndices(model, strands.indices);
  primitive.extras = tyndallExtras(
      "strand", {{"width", tinygltf::Value(strands.width)}, {"opacity", tinygltf::Value(strands.opacity)}});
  tinygltf::Mesh mesh;
  mesh.name = strands.name;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
  appendMeshNode(model, strands.name, static_cast<int>(model.meshes.size()) - 1);
}

void appendSmoke(tinygltf::Model& model, const Smoke& smoke) {
  tinygltf::Node node;
  node.name = smoke.name;
  node.translation = listOf(smoke.position);
  node.extras = tyndallExtras("smoke", {{"particles", tinygltf::Value(smoke.particles)},
                                        {"radius", tinygltf::Value(smoke.radius)},
                                        {"growth", tinygltf::Value(smoke.growth)},
                                        {"density", tinygltf::Value(smoke.density)},
                                        {"spread", tinygltf::Value(smoke.spread)},
                                        {"height", tinygltf::Value(smoke.height)},
                                        {"rise", tinygltf::Value(smoke.rise)},
                                        {"drift", valueOf(smoke.drift)},
                                        {"turbulence", tinygltf::Value(smoke.turbulence)},
                                        {"albedo", valueOf(smoke.albedo)},
                                        {"seed", tinygltf::Value(smoke.seed)}});
  appendNode(model, node);
}

/// A node at a place whose -z axis looks along a direction, as glTF's cameras and lights do.
tinygltf::Node nodeLooking(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction) {
  const glm::dvec3 z = -glm::normalize(direction);
  const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
  const glm::dquat turn = glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
  tinygltf::Node node;
  node.name = name;
  node.translation = listOf(position);
  // Single precision keeps the last bits of the square roots and cosines above out of the file.
  for (const double component : {turn.x, turn.y, turn.z, turn.w})
    node.rotation.push_back(static_cast<double>(static_cast<float>(component)));
  return node;
}

void appendCamera(tinygltf::Model& model, const Camera& source) {
  tinygltf::Camera camera;
  camera.name = "view";
  camera.type = "perspective";
  camera.perspective.aspectRatio = 16.0 / 9.0;
  camera.perspective.yfov = glm::radians(source.verticalFov);
  camera.perspective.znear = source.nearPlane;
  camera.perspective.zfar = source.farPlane;
  model.cameras.push_back(camera);
  tinygltf::Node node = nodeLooking("camera", source.eye, source.target - source.eye);
  node.camera = 0;
  appendNode(model, node);
}

void appendLight(tinygltf::Model& model, const Light& source) {
  tinygltf::Light light;
  light.name = source.name;
  light.color = listOf(source.colour);
  light.intensity = source.intensity;
  switch (source.kind) {
  case LightKind::Directional:
    light.type = "directional";
    break;
  case LightKind::Point:
    light.type = "point";
    break;
  case LightKind::Spot:
    light.type = "spot";
    break;
  }
  if (source.kind == LightKind::Spot) {
    light.spot.innerConeAngle = glm::radians(source.innerConeAngle);
    light.spot.outerConeAngle = glm::radians(source.outerConeAngle);
  }
  tinygltf::Node node = nodeLooking(source.name, source.position, source.direction);
  node.extensions[kLights] =
      tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(static_cast<int>(model.lights.size()))}});
  model.lights.push_back(light);
  appendNode(model, node);
}

tinygltf::Value extrasOf(const Scene& scene) {
  tinygltf::Value::Array constituents;
  for (const Constituent& c : scene.constituents) {
    tinygltf::Value::Object object{{"phase", tinygltf::Value(c.phase)}, {"scattering", valueOf(c.scattering)}};
    if (c.g != 0) object["g"] = tinygltf::Value(c.g);
    constituents.emplace_back(object);
  }
  const tinygltf::Value::Object medium{{"constituents", tinygltf::Value(constituents)},
                                       {"absorption", valueOf(scene.absorption)}};
  const tinygltf::Value::Object tyndall{{"medium", tinygltf::Value(medium)}, {"sky", valueOf(scene.sky)}};
  return tinygltf::Value(tinygltf::Value::Object{{"tyndall", tinygltf::Value(tyndall)}});
}

} // namespace

void writeGlb(const Scene& scene, const std::string& path) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "tyndall-make-scenes";
  model.buffers.resize(1);
  model.scenes.resize(1);
  model.scenes[0].name = scene.name;
  model.scenes[0].extras = extrasOf(scene);
  model.defaultScene = 0;
  const std::vector<int> materials = appendMaterials(model, scene);
  appendMeshNode(model, scene.name, appendMesh(model, scene.name, scene.surfaces, materials));
  appendBodies(model, scene, materials);
  for (const Strands& strands : scene.strands)
    appendStrands(model, strands, materials);
  for (const Smoke& smoke : scene.smoke)
    appendSmoke(model, smoke);
  appendCamera(model, scene.camera);
  for (const Light& light : scene.lights)
    appendLight(model, light);

  // tinygltf tells the format by the name, so the name written beside the file ends in .glb, too.
  const std::string beside = path + ".part.glb";
  tinygltf::TinyGLTF writer;
  std::error_code failure;
  const bool written = writer.WriteGltfSceneToFile(&model, beside, false, true, false, true);
  if (written) std::filesystem::rename(beside, path, failure);
  if (written && !failure) return;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  throw std::runtime_error(path + ": cannot be written" + (failure ? ": " + failure.message() : ""));
}

} // namespace scenes
