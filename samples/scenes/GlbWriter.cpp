#include "GlbWriter.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <scene/Error.h>
#include <scene/FileIo.h>

namespace scenes {
namespace {

using nlohmann::json;

// glTF's numbers, which are GL's.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLines = 1, kTriangles = 4;

constexpr const char* kLights = "KHR_lights_punctual";
constexpr const char* kTransmission = "KHR_materials_transmission";

/// The file in the making.
struct Document {
  explicit Document(const Scene& scene);

  json root;
  std::vector<std::uint8_t> bytes; ///< of its one buffer
};

json listOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Appends to a list of the root; returns the index.
int append(Document& document, const char* list, json element) {
  json& elements = document.root[list];
  elements.push_back(std::move(element));
  return static_cast<int>(elements.size()) - 1;
}

void use(Document& document, const char* extension) {
  json& used = document.root["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

/// Appends an accessor to items of its own. target: what the items are for, 0 for key frames.
template <class T>
int appendItems(Document& document, const std::vector<T>& items, int target, json accessor) {
  json view = {{"buffer", 0}, {"byteOffset", document.bytes.size()}, {"byteLength", items.size() * sizeof(T)}};
  if (target != 0) view["target"] = target;
  const std::size_t offset = document.bytes.size();
  document.bytes.resize(offset + items.size() * sizeof(T));
  std::memcpy(document.bytes.data() + offset, items.data(), items.size() * sizeof(T));
  accessor["bufferView"] = append(document, "bufferViews", std::move(view));
  accessor["count"] = items.size();
  return append(document, "accessors", std::move(accessor));
}

int appendVectors(Document& document, const std::vector<glm::dvec3>& vectors, bool withBounds) {
  std::vector<glm::vec3> packed;
  packed.reserve(vectors.size());
  glm::vec3 low(vectors.front());
  glm::vec3 high = low;
  for (const glm::dvec3& v : vectors) {
    packed.emplace_back(v);
    low = glm::min(low, packed.back());
    high = glm::max(high, packed.back());
  }
  json accessor = {{"componentType", kFloat}, {"type", "VEC3"}};
  if (withBounds) {
    accessor["min"] = listOf(low);
    accessor["max"] = listOf(high);
  }
  return appendItems(document, packed, kArrayBuffer, std::move(accessor));
}

/// In steps of a thousandth: files are packed.
int appendColours(Document& document, const std::vector<glm::dvec3>& colours) {
  constexpr double kSteps = 1023, kStep = 64;
  std::vector<glm::u16vec4> packed;
  packed.reserve(colours.size());
  for (const glm::dvec3& colour : colours)
    packed.emplace_back(glm::u16vec3(kStep * glm::round(kSteps * glm::clamp(colour, 0.0, 1.0))), 65535);
  return appendItems(document, packed, kArrayBuffer,
                     {{"componentType", kUnsignedShort}, {"type", "VEC4"}, {"normalized", true}});
}

int appendIndices(Document& document, const std::vector<std::uint32_t>& indices) {
  return appendItems(document, indices, kElementArrayBuffer, {{"componentType", kUnsignedInt}, {"type", "SCALAR"}});
}

json materialOf(const Material& source) {
  json material = {
      {"name", source.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {source.colour.r, source.colour.g, source.colour.b, 1.0}}, {"metallicFactor", 0.0}}},
      {"emissiveFactor", listOf(source.emission)},
      {"doubleSided", source.doubleSided}};
  if (source.glass) material["extensions"][kTransmission] = {{"transmissionFactor", 1.0}};
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
std::vector<int> appendMaterials(Document& document, const Scene& scene) {
  std::vector<int> indices(scene.materials.size(), -1);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!isUsed(scene, i)) continue;
    indices[i] = append(document, "materials", materialOf(scene.materials[i]));
    if (scene.materials[i].glass) use(document, kTransmission);
  }
  return indices;
}

int appendMesh(Document& document, const std::string& name, const std::vector<Surface>& surfaces,
               const std::vector<int>& materials) {
  json primitives = json::array();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    if (surface.indices.empty()) continue;
    const int positions = appendVectors(document, surface.positions, true);
    const int normals = appendVectors(document, surface.normals, false);
    json attributes = {{"POSITION", positions}, {"NORMAL", normals}};
    if (!surface.colours.empty()) attributes["COLOR_0"] = appendColours(document, surface.colours);
    primitives.push_back({{"mode", kTriangles},
                          {"material", materials[i]},
                          {"attributes", attributes},
                          {"indices", appendIndices(document, surface.indices)}});
  }
  return append(document, "meshes", {{"name", name}, {"primitives", primitives}});
}

/// Appends a node and shows it in the scene, or, with a parent, as part of that.
int appendNode(Document& document, json node, int parent = -1) {
  const int index = append(document, "nodes", std::move(node));
  if (parent < 0)
    document.root["scenes"][0]["nodes"].push_back(index);
  else
    document.root["nodes"][static_cast<std::size_t>(parent)]["children"].push_back(index);
  return index;
}

/// Appends `values`, those of one key after another, and the channel that plays them.
template <class T>
void appendChannel(Document& document, int node, const char* path, int times, const char* type,
                   const std::vector<T>& values) {
  const int output = appendItems(document, values, 0, {{"componentType", kFloat}, {"type", type}});
  json& animation = document.root["animations"][0];
  animation["samplers"].push_back({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

void appendMotion(Document& document, int node, const std::vector<Pose>& poses) {
  std::vector<float> times;
  std::vector<std::array<float, 3>> translations;
  std::vector<std::array<float, 4>> rotations;
  for (const Pose& pose : poses) {
    times.push_back(static_cast<float>(pose.seconds));
    const glm::vec3 t(pose.translation);
    translations.push_back({t.x, t.y, t.z});
    const glm::quat q(pose.rotation);
    rotations.push_back({q.x, q.y, q.z, q.w});
  }
  const int input = appendItems(document, times, 0,
                                {{"componentType", kFloat},
                                 {"type", "SCALAR"},
                                 {"min", json::array({times.front()})},
                                 {"max", json::array({times.back()})}});
  appendChannel(document, node, "translation", input, "VEC3", translations);
  appendChannel(document, node, "rotation", input, "VEC4", rotations);
}

/// Returns the node of each.
std::vector<int> appendBodies(Document& document, const Scene& scene, const std::vector<int>& materials) {
  std::vector<int> nodes;
  if (scene.bodies.empty()) return nodes;
  document.root["animations"][0]["name"] = scene.name;
  for (const Body& body : scene.bodies) {
    const int mesh = appendMesh(document, body.name, body.surfaces, materials);
    nodes.push_back(appendNode(document, {{"name", body.name}, {"mesh", mesh}}));
    appendMotion(document, nodes.back(), body.poses);
  }
  return nodes;
}

void appendStrands(Document& document, const Strands& strands, const std::vector<int>& materials) {
  const json primitive = {
      {"mode", kLines},
      {"material", materials[static_cast<std::size_t>(strands.material)]},
      {"attributes", {{"POSITION", appendVectors(document, strands.points, true)}}},
      {"indices", appendIndices(document, strands.indices)},
      {"extras", {{"tyndall", {{"strand", {{"width", strands.width}, {"opacity", strands.opacity}}}}}}}};
  const int mesh = append(document, "meshes", {{"name", strands.name}, {"primitives", json::array({primitive})}});
  appendNode(document, {{"name", strands.name}, {"mesh", mesh}});
}

void appendSmoke(Document& document, const Smoke& smoke) {
  const json fields = {{"particles", smoke.particles},
                       {"radius", smoke.radius},
                       {"growth", smoke.growth},
                       {"density", smoke.density},
                       {"spread", smoke.spread},
                       {"height", smoke.height},
                       {"rise", smoke.rise},
                       {"drift", listOf(smoke.drift)},
                       {"turbulence", smoke.turbulence},
                       {"albedo", listOf(smoke.albedo)},
                       {"seed", smoke.seed}};
  appendNode(
      document,
      {{"name", smoke.name}, {"translation", listOf(smoke.position)}, {"extras", {{"tyndall", {{"smoke", fields}}}}}});
}

void appendFog(Document& document, const Fog& fog) {
  json fields = {{"shape", fog.sphere ? "sphere" : "box"}, {"extinction", fog.extinction}, {"fade", fog.fade}};
  if (fog.billows != glm::ivec3(0)) {
    fields["billows"] = json::array({fog.billows.x, fog.billows.y, fog.billows.z});
    fields["clear"] = fog.clear;
    fields["seed"] = fog.seed;
  }
  appendNode(document, {{"name", fog.name},
                        {"translation", listOf(fog.position)},
                        {"scale", listOf(fog.halfSize)},
                        {"extras", {{"tyndall", {{"fog", fields}}}}}});
}

/// A node at a place whose -z axis looks along a direction, as glTF's cameras and lights do.
json nodeLooking(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction) {
  const glm::dvec3 z = -glm::normalize(direction);
  const glm::dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), z));
  const glm::dquat turn = glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
  json rotation;
  // Single precision keeps the last bits of the square roots and cosines above out of the file.
  for (const double component : {turn.x, turn.y, turn.z, turn.w})
    rotation.push_back(static_cast<double>(static_cast<float>(component)));
  return {{"name", name}, {"translation", listOf(position)}, {"rotation", rotation}};
}

void appendCamera(Document& document, const Camera& source) {
  json node = nodeLooking("camera", source.eye, source.target - source.eye);
  node["camera"] = append(document, "cameras",
                          {{"name", "view"},
                           {"type", "perspective"},
                           {"perspective",
                            {{"aspectRatio", 16.0 / 9.0},
                             {"yfov", glm::radians(source.verticalFov)},
                             {"znear", source.nearPlane},
                             {"zfar", source.farPlane}}}});
  appendNode(document, std::move(node));
}

const char* nameOf(LightKind kind) {
  switch (kind) {
  case LightKind::Point:
    return "point";
  case LightKind::Spot:
    return "spot";
  case LightKind::Directional:
    break;
  }
  return "directional";
}

void appendLight(Document& document, const Light& source, const std::vector<int>& bodies) {
  json light = {{"name", source.name},
                {"type", nameOf(source.kind)},
                {"color", listOf(source.colour)},
                {"intensity", source.intensity}};
  if (source.kind == LightKind::Spot)
    light["spot"] = {{"innerConeAngle", glm::radians(source.innerConeAngle)},
                     {"outerConeAngle", glm::radians(source.outerConeAngle)}};
  use(document, kLights);
  json& lights = document.root["extensions"][kLights]["lights"];
  json node = nodeLooking(source.name, source.position, source.direction);
  node["extensions"][kLights]["light"] = lights.size();
  lights.push_back(std::move(light));
  appendNode(document, std::move(node), source.body < 0 ? -1 : bodies[static_cast<std::size_t>(source.body)]);
}

json extrasOf(const Scene& scene) {
  json constituents = json::array();
  for (const Constituent& c : scene.constituents) {
    constituents.push_back({{"phase", c.phase}, {"scattering", listOf(c.scattering)}});
    if (c.g != 0) constituents.back()["g"] = c.g;
    if (c.layer >= 0) constituents.back()["layer"] = c.layer;
  }
  json medium = {{"constituents", constituents}, {"absorption", listOf(scene.absorption)}};
  for (const Layer& layer : scene.layers)
    medium["layers"].push_back({{"height", layer.height}, {"scale", layer.scale}, {"ground", layer.ground}});
  if (scene.farDistance > 0) medium["farDistance"] = scene.farDistance;
  json extras = {{"medium", medium}, {"sky", listOf(scene.sky)}};
  if (scene.ambient != glm::dvec3(0)) extras["ambient"]["radiance"] = listOf(scene.ambient);
  if (!scene.fog.empty() || scene.isSmokeLit)
    extras["fog"] = {{"albedo", listOf(scene.fogAlbedo)}, {"phase", "henyey-greenstein"}, {"g", scene.fogG}};
  return {{"tyndall", extras}};
}

Document::Document(const Scene& scene) {
  root = {{"asset", {{"version", "2.0"}, {"generator", "tyndall-make-scenes"}}}, {"scene", 0}};
  root["scenes"][0] = {{"name", scene.name}, {"extras", extrasOf(scene)}};
  const std::vector<int> materials = appendMaterials(*this, scene);
  const int mesh = appendMesh(*this, scene.name, scene.surfaces, materials);
  appendNode(*this, {{"name", scene.name}, {"mesh", mesh}});
  const std::vector<int> bodies = appendBodies(*this, scene, materials);
  for (const Strands& strands : scene.strands)
    appendStrands(*this, strands, materials);
  for (const Smoke& smoke : scene.smoke)
    appendSmoke(*this, smoke);
  for (const Fog& fog : scene.fog)
    appendFog(*this, fog);
  appendCamera(*this, scene.camera);
  for (const Light& light : scene.lights)
    appendLight(*this, light, bodies);
  root["buffers"][0]["byteLength"] = bytes.size();
}

/// glTF 2.0, section 4.4: a header, and two chunks whose lengths are multiples of 4. Little-endian, as the machine's
/// numbers are.
void writeContainer(std::ostream& stream, std::string text, std::vector<std::uint8_t> bytes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  text.resize(padded(text.size()), ' ');
  bytes.resize(padded(bytes.size()), 0);
  constexpr std::size_t kHeaders = 12 + 8 + 8;
  if (kHeaders + text.size() + bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw host::Error("is too large for a binary glTF file");
  const auto number = [&stream](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    stream.write(reinterpret_cast<const char*>(&word), sizeof word);
  };
  stream.write("glTF", 4);
  number(2);
  number(kHeaders + text.size() + bytes.size());
  number(text.size());
  stream.write("JSON", 4);
  stream << text;
  number(bytes.size());
  stream.write("BIN\0", 4);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void writeGlb(const Scene& scene, const std::string& path) {
  const Document document(scene);
  host::writeAndRename(path, [&document](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    writeContainer(stream, document.root.dump(), document.bytes);
    if (!stream.flush()) throw host::Error("the disk may be full");
  });
}

} // namespace scenes
