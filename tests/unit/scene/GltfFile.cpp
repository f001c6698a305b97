#include "GltfFile.h"
#include "support/Catch.h"

#include <fstream>
#include <scene/Error.h>
#include <scene/GltfLoader.h>
#include <scene/ImageFile.h>
#include <stdexcept>
#include <stdlib.h>

namespace tests {

namespace {

void append32(std::vector<std::uint8_t>& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

void appendChunk(std::vector<std::uint8_t>& glb, std::size_t type, std::vector<std::uint8_t> data, char padding) {
  data.resize((data.size() + 3) / 4 * 4, static_cast<std::uint8_t>(padding));
  append32(glb, data.size());
  append32(glb, type);
  glb.insert(glb.end(), data.begin(), data.end());
}

std::vector<std::uint8_t> smallPng() {
  const TemporaryFolder folder;
  host::writePng(folder / "image.png", 2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
  return readBytes(folder / "image.png");
}

void addMaterials(GltfFile& file) {
  file.json["images"] = {{{"bufferView", file.view(smallPng())}, {"mimeType", "image/png"}}};
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  const nlohmann::json transform = {{"offset", {0.5, 0.25}}, {"rotation", 0.5}, {"scale", {2, 3}}, {"texCoord", 0}};
  const nlohmann::json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  const nlohmann::json glass = {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                                {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}};
  file.json["materials"] = {{{"name", "textured"},
                             {"alphaMode", "MASK"},
                             {"alphaCutoff", 0.25},
                             {"pbrMetallicRoughness", {{"baseColorTexture", texture}}}},
                            {{"name", "glass"},
                             {"emissiveFactor", {0.5, 0.25, 0}},
                             {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.25, 1}}}},
                             {"extensions", glass}}};
}

void addMeshes(GltfFile& file) {
  // Position, normal and texture coordinates of a square, interleaved.
  const std::vector<float> square = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0,
                                     1, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 1};
  const int view = file.view(square, 32);
  const int positions = file.accessor(view, kFloat, "VEC3", 4);
  const int normals = file.accessor(view, kFloat, "VEC3", 4, 12);
  const int uvs = file.accessor(view, kFloat, "VEC2", 4, 24);
  const int indices =
      file.accessor(file.view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), kUnsignedShort, "SCALAR", 6);
  const int sparseIndices = file.view(std::vector<std::uint8_t>{3, 0, 0, 0});
  const int sparseValues = file.view(std::vector<float>{0, 2, 0});
  file.json["accessors"][static_cast<std::size_t>(positions)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparseIndices}, {"componentType", kUnsignedByte}}},
      {"values", {{"bufferView", sparseValues}}}};
  const int quantised = file.accessor(
      file.view(std::vector<std::int8_t>{0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0, 127, 127, 0, 0}, 4), kByte, "VEC3", 4);
  file.json["accessors"][static_cast<std::size_t>(quantised)]["normalized"] = true;
  file.json["meshes"] = {
      {{"name", "square"},
       {"primitives",
        {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
          {"indices", indices},
          {"material", 0}}}}},
      {{"name", "strip"}, {"primitives", {{{"attributes", {{"POSITION", quantised}}}, {"mode", 5}, {"material", 1}}}}}};
}

void addAnimation(GltfFile& file) {
  const int times = file.floats({0, 1, 2}, "SCALAR", 1);
  const int moves = file.floats({0, 0, 0, 1, 2, 3, 2, 4, 6}, "VEC3", 3);
  const int turns = file.floats({0, 0, 0, 1, 0, 0.70710678F, 0, 0.70710678F, 0, 1, 0, 0}, "VEC4", 4);
  const int splines = file.floats(std::vector<float>(27, 1.0F), "VEC3", 3);
  const auto channel = [](int sampler, int node, const char* path) {
    return nlohmann::json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
  };
  file.json["animations"] = {
      {{"samplers",
        {{{"input", times}, {"output", moves}, {"interpolation", "STEP"}},
         {{"input", times}, {"output", turns}},
         {{"input", times}, {"output", splines}, {"interpolation", "CUBICSPLINE"}}}},
       {"channels", {channel(0, 1, "translation"), channel(1, 1, "rotation"), channel(2, 1, "scale")}}}};
}

} // namespace

std::vector<std::uint8_t> readBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void writeBytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes) {
  // Some file systems flush a file that is overwritten: thousands of small ones are much faster when made anew.
  std::filesystem::remove(file);
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

int GltfFile::addView(const std::uint8_t* data, std::size_t size, int stride) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
  if (stride != 0) view["byteStride"] = stride;
  bytes.insert(bytes.end(), data, data + size);
  json["bufferViews"].push_back(view);
  json["buffers"] = {{{"byteLength", bytes.size()}}};
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfFile::accessor(int view, int componentType, const char* type, std::size_t count, std::size_t offset) {
  nlohmann::json accessor = {{"componentType", componentType}, {"type", type}, {"count", count}};
  if (view >= 0) accessor["bufferView"] = view;
  if (offset != 0) accessor["byteOffset"] = offset;
  json["accessors"].push_back(accessor);
  return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfFile::floats(const std::vector<float>& values, const char* type, std::size_t components) {
  return accessor(view(values), kFloat, type, values.size() / components);
}

void GltfFile::show(const nlohmann::json& primitive) {
  json["meshes"].push_back({{"primitives", {primitive}}});
  json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
  json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
}

std::vector<std::uint8_t> GltfFile::glb() const {
  const std::string text = json.dump();
  std::vector<std::uint8_t> chunks;
  appendChunk(chunks, 0x4E4F534A, {text.begin(), text.end()}, ' ');
  if (!bytes.empty()) appendChunk(chunks, 0x004E4942, bytes, 0);
  std::vector<std::uint8_t> file;
  append32(file, 0x46546C67);
  append32(file, 2);
  append32(file, 12 + chunks.size());
  file.insert(file.end(), chunks.begin(), chunks.end());
  return file;
}

host::Scene GltfFile::load() const {
  const TemporaryFolder folder;
  writeBytes(folder / "scene.glb", glb());
  return host::loadScene(folder / "scene.glb");
}

std::string GltfFile::refusal() const {
  try {
    load();
  } catch (const host::Error& error) {
    const std::string message = error.what();
    CHECK(message.find("scene.glb: ") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  FAIL("the file was not refused");
  return {};
}

bool hasNote(const host::Scene& scene, const std::string& text) {
  for (const std::string& note : scene.notes) {
    if (note.find(text) != std::string::npos) return true;
  }
  return false;
}

GltfFile everything() {
  GltfFile file;
  addMaterials(file);
  addMeshes(file);
  addAnimation(file);
  file.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform",
                                 "KHR_materials_transmission", "KHR_materials_emissive_strength"};
  file.json["extensionsRequired"] = {"KHR_lights_punctual", "KHR_mesh_quantization"};
  file.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"zfar", 100}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 1.5}, {"znear", 0}, {"zfar", 50}}}}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"color", {1, 0.5, 0.25}}, {"intensity", 4}},
      {{"type", "point"}, {"range", 10}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
  const auto light = [](int index) { return nlohmann::json{{"KHR_lights_punctual", {{"light", index}}}}; };
  file.json["nodes"] = {{{"name", "root"}, {"children", {1, 2}}, {"translation", {0, 1, 0}}, {"scale", {2, 2, 2}}},
                        {{"name", "moving"}, {"mesh", 0}, {"children", {3}}},
                        {{"name", "matrix"}, {"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}},
                        {{"camera", 0}, {"extensions", light(2)}},
                        {{"camera", 1}, {"extensions", light(0)}},
                        {{"rotation", {0, 0, 0, 1}}, {"extensions", light(1)}}};
  const nlohmann::json medium = {
      {"constituents", {{{"scattering", {0.1, 0.2, 0.3}}, {"phase", "henyey-greenstein"}, {"g", 0.6}}}},
      {"absorption", {0.01, 0.01, 0.01}}};
  file.json["scene"] = 0;
  file.json["scenes"] = {{{"name", "all"},
                          {"nodes", {0, 4, 5}},
                          {"extras", {{"tyndall", {{"medium", medium}, {"sky", {0.1, 0.2, 0.4}}}}}}}};
  return file;
}

} // namespace tests
