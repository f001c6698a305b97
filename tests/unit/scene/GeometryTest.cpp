#include "GltfFile.h"
#include "support/Catch.h"

#include <array>
#include <scene/GltfLoader.h>

namespace tests {

namespace {

using Indices = std::vector<std::uint32_t>;

/// Five points of a zigzag strip in the plane z = 0, counter-clockwise for the first triangle.
const std::vector<float> kZigzag = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

host::Primitive loadMode(int mode, const Indices& indices = {}) {
  GltfFile file;
  nlohmann::json primitive = {{"attributes", {{"POSITION", file.floats(kZigzag, "VEC3", 3)}}}, {"mode", mode}};
  // Normals keep the loader from splitting the vertices for flat ones.
  primitive["attributes"]["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  if (!indices.empty()) {
    primitive["indices"] = file.accessor(file.view(indices), kUnsignedInt, "SCALAR", indices.size());
  }
  file.show(primitive);
  return file.load().meshes.at(0).primitives.at(0);
}

glm::vec3 firstPosition(const GltfFile& file) {
  return file.load().meshes.at(0).primitives.at(0).vertices.at(0).position;
}

/// A file with a point whose position accessor is the given one.
GltfFile point(const GltfFile& file, int accessor) {
  GltfFile result = file;
  result.show({{"attributes", {{"POSITION", accessor}}}, {"mode", 0}});
  return result;
}

} // namespace

TEST_CASE("All primitive modes are unrolled", "[scene][gltf]") {
  CHECK(loadMode(0).indices == Indices{0, 1, 2, 3, 4});
  CHECK(loadMode(0).topology == host::Topology::Points);
  CHECK(loadMode(1).indices == Indices{0, 1, 2, 3});
  CHECK(loadMode(2).indices == Indices{0, 1, 1, 2, 2, 3, 3, 4, 4, 0});
  CHECK(loadMode(3).indices == Indices{0, 1, 1, 2, 2, 3, 3, 4});
  CHECK(loadMode(3).topology == host::Topology::Lines);
  CHECK(loadMode(4).indices == Indices{0, 1, 2});
  CHECK(loadMode(5).indices == Indices{0, 1, 2, 1, 3, 2, 2, 3, 4});
  CHECK(loadMode(6).indices == Indices{1, 2, 0, 2, 3, 0, 3, 4, 0});
  CHECK(loadMode(6).topology == host::Topology::Triangles);
  CHECK(loadMode(5, {4, 3, 2, 1}).indices == Indices{4, 3, 2, 3, 1, 2});
}

TEST_CASE("Strips keep the winding of their first triangle", "[scene][gltf]") {
  const host::Primitive strip = loadMode(5);
  for (std::size_t i = 0; i < strip.indices.size(); i += 3) {
    const auto corner = [&](std::size_t c) { return strip.vertices[strip.indices[i + c]].position; };
    CHECK(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z > 0);
  }
}

TEST_CASE("All index types are read", "[scene][gltf]") {
  const auto type = GENERATE(kUnsignedByte, kUnsignedShort, kUnsignedInt);
  GltfFile file;
  const int positions = file.floats(kZigzag, "VEC3", 3);
  const int view = type == kUnsignedByte    ? file.view(std::vector<std::uint8_t>{4, 0, 3})
                   : type == kUnsignedShort ? file.view(std::vector<std::uint16_t>{4, 0, 3})
                                            : file.view(std::vector<std::uint32_t>{4, 0, 3});
  file.show(
      {{"attributes", {{"POSITION", positions}}}, {"indices", file.accessor(view, type, "SCALAR", 3)}, {"mode", 0}});
  CHECK(file.load().meshes.at(0).primitives.at(0).indices == Indices{4, 0, 3});
}

TEST_CASE("Triangles without normals get flat ones", "[scene][gltf]") {
  GltfFile file;
  const int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
  const int indices = file.accessor(file.view(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}), kUnsignedByte, "SCALAR", 6);
  file.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  const host::Primitive primitive = file.load().meshes.at(0).primitives.at(0);
  REQUIRE(primitive.vertices.size() == 6);
  CHECK(primitive.indices == Indices{0, 1, 2, 3, 4, 5});
  CHECK(primitive.vertices[0].normal == glm::vec3(0, 0, 1));
  CHECK(primitive.vertices[5].normal == glm::vec3(1, 0, 0));
}

TEST_CASE("Normals that cannot be normalised are taken from the triangles", "[scene][gltf]") {
  GltfFile file;
  const int positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  const int normals = file.floats({0, 0, 0, 3, 0, 0, 0, NAN, 0}, "VEC3", 3);
  file.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
  const host::Scene scene = file.load();
  const host::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  CHECK(primitive.vertices.at(0).normal == glm::vec3(0, 0, 1));
  CHECK(primitive.vertices.at(1).normal == glm::vec3(1, 0, 0));
  CHECK(primitive.vertices.at(2).normal == glm::vec3(0, 0, 1));
  CHECK(hasNote(scene, "meshes[0].primitives[0].attributes.NORMAL"));
}

TEST_CASE("Vertex colours are read in all types that glTF allows", "[scene][gltf]") {
  using Colour = glm::u16vec4;
  const auto load = [](const char* type, int componentType, const auto& values, bool normalized = true) {
    GltfFile file;
    const int positions = file.floats({0, 0, 0, 1, 0, 0}, "VEC3", 3);
    const int colours = file.accessor(file.view(values), componentType, type, 2);
    if (normalized) file.json["accessors"][static_cast<std::size_t>(colours)]["normalized"] = true;
    file.show({{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}}, {"mode", 0}});
    return file.load();
  };
  const auto coloursOf = [](const host::Scene& scene) {
    const std::vector<host::Vertex>& vertices = scene.meshes.at(0).primitives.at(0).vertices;
    return std::array<Colour, 2>{vertices.at(0).colour, vertices.at(1).colour};
  };
  const char* const kWhere = "meshes[0].primitives[0].attributes.COLOR_0";
  const std::array<Colour, 2> wanted = {Colour(0, 65535, 13107, 65535), Colour(65535, 0, 65535, 65535)};
  const host::Scene floats = load("VEC3", kFloat, std::vector<float>{0, 1, 0.2F, 1, 0, 1}, false);
  CHECK(coloursOf(floats) == wanted);
  CHECK_FALSE(hasNote(floats, kWhere));
  CHECK(coloursOf(load("VEC4", kUnsignedShort,
                       std::vector<std::uint16_t>{0, 65535, 13107, 65535, 65535, 0, 65535, 65535})) == wanted);
  CHECK(coloursOf(load("VEC4", kUnsignedByte, std::vector<std::uint8_t>{0, 255, 51, 255, 255, 0, 255, 255})) == wanted);
  // What is out of range, or of another type, is said.
  const host::Scene wild = load("VEC3", kFloat, std::vector<float>{-1, 7, 0.2F, 1, NAN, 1}, false);
  CHECK(coloursOf(wild) == wanted);
  CHECK(hasNote(wild, kWhere));
  const host::Scene veiled = load("VEC4", kFloat, std::vector<float>{0, 1, 0.2F, 0.5F, 1, 0, 1, 1}, false);
  CHECK(coloursOf(veiled) == wanted);
  CHECK(hasNote(veiled, kWhere));
  const host::Scene whole = load("VEC3", kUnsignedInt, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}, false);
  CHECK(coloursOf(whole) == std::array<Colour, 2>{Colour(65535), Colour(65535)});
  CHECK(hasNote(whole, kWhere));
}

TEST_CASE("Interleaved attributes are told apart", "[scene][gltf]") {
  const host::Primitive square = everything().load().meshes.at(0).primitives.at(0);
  REQUIRE(square.vertices.size() == 4);
  CHECK(square.vertices[2].position == glm::vec3(1, 1, 0));
  CHECK(square.vertices[2].normal == glm::vec3(0, 0, 1));
  CHECK(square.indices == Indices{0, 1, 2, 0, 2, 3});
}

TEST_CASE("Sparse values replace those of the view, or zeros", "[scene][gltf]") {
  CHECK(everything().load().meshes.at(0).primitives.at(0).vertices.at(3).position == glm::vec3(0, 2, 0));

  const auto type = GENERATE(kUnsignedByte, kUnsignedShort, kUnsignedInt);
  GltfFile file;
  const int accessor = file.accessor(-1, kFloat, "VEC3", 3);
  const int indices = type == kUnsignedByte    ? file.view(std::vector<std::uint8_t>{1, 2})
                      : type == kUnsignedShort ? file.view(std::vector<std::uint16_t>{1, 2})
                                               : file.view(std::vector<std::uint32_t>{1, 2});
  const int values = file.view(std::vector<float>{1, 2, 3, 4, 5, 6});
  file.json["accessors"][static_cast<std::size_t>(accessor)]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", type}}},
      {"values", {{"bufferView", values}}}};
  const host::Scene scene = point(file, accessor).load();
  const std::vector<host::Vertex>& vertices = scene.meshes.at(0).primitives.at(0).vertices;
  CHECK(vertices.at(0).position == glm::vec3(0));
  CHECK(vertices.at(1).position == glm::vec3(1, 2, 3));
  CHECK(vertices.at(2).position == glm::vec3(4, 5, 6));
}

TEST_CASE("Quantised positions are decoded as glTF says", "[scene][gltf]") {
  GltfFile file;
  file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  const auto add = [&](int view, int type, bool normalized) {
    const int accessor = file.accessor(view, type, "VEC3", 1);
    file.json["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = normalized;
    return accessor;
  };
  const int bytes = file.view(std::vector<std::int8_t>{-128, -127, 127, 0});
  const int words = file.view(std::vector<std::int16_t>{-32768, 16384, 32767, 0});
  const int unsignedBytes = file.view(std::vector<std::uint8_t>{0, 51, 255, 0});
  const int unsignedWords = file.view(std::vector<std::uint16_t>{0, 13107, 65535, 0});
  CHECK(firstPosition(point(file, add(bytes, kByte, true))) == glm::vec3(-1, -1, 1));
  CHECK(firstPosition(point(file, add(bytes, kByte, false))) == glm::vec3(-128, -127, 127));
  CHECK(firstPosition(point(file, add(words, kShort, true))) == glm::vec3(-1, 16384.0F / 32767.0F, 1));
  CHECK(firstPosition(point(file, add(words, kShort, false))) == glm::vec3(-32768, 16384, 32767));
  CHECK(firstPosition(point(file, add(unsignedBytes, kUnsignedByte, true))) == glm::vec3(0, 0.2F, 1));
  CHECK(firstPosition(point(file, add(unsignedBytes, kUnsignedByte, false))) == glm::vec3(0, 51, 255));
  CHECK(firstPosition(point(file, add(unsignedWords, kUnsignedShort, true))) == glm::vec3(0, 0.2F, 1));
  CHECK(firstPosition(point(file, add(unsignedWords, kUnsignedShort, false))) == glm::vec3(0, 13107, 65535));
}

TEST_CASE("Geometry that is undefined is refused by name", "[scene][gltf]") {
  GltfFile file;
  const int positions = file.floats(kZigzag, "VEC3", 3);
  const auto refusal = [&](const std::string& path, const nlohmann::json& value) {
    GltfFile broken = everything();
    broken.json[nlohmann::json::json_pointer(path)] = value;
    return broken.refusal();
  };
  using Catch::Contains;
  CHECK_THAT(refusal("/accessors/0/count", 5), Contains("accessors[0].count: reads up to byte"));
  CHECK_THAT(refusal("/accessors/0/count", 18446744073709551615ULL), Contains("accessors[0].count"));
  CHECK_THAT(refusal("/accessors/0/byteOffset", 2147483647), Contains("accessors[0].count"));
  CHECK_THAT(refusal("/accessors/0/sparse/count", 5), Contains("accessors[0].sparse.count"));
  CHECK_THAT(refusal("/bufferViews/0/byteOffset", 1 << 20), Contains("bufferViews[0].byteLength"));
  CHECK_THAT(refusal("/bufferViews/0/byteLength", -1), Contains("bufferViews[0].byteLength"));
  CHECK_THAT(refusal("/meshes/0/primitives/0/mode", 7), Contains("meshes[0].primitives[0].mode"));
  CHECK_THAT(refusal("/meshes/0/primitives/0/attributes/POSITION", 99), Contains("attributes.POSITION"));
  CHECK_THAT(refusal("/buffers/0/byteLength", 1 << 20), Contains("buffers[0].byteLength"));
  CHECK_THAT(refusal("/asset/version", "1.0"), Contains("asset.version"));
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_unknown"}) {
    CHECK_THAT(refusal("/extensionsRequired/0", extension), Contains("extensionsRequired[0]: ") && Contains(extension));
  }

  GltfFile outside = file;
  const int indices = outside.accessor(outside.view(std::vector<std::uint8_t>{0, 5, 1}), kUnsignedByte, "SCALAR", 3);
  outside.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  CHECK_THAT(outside.refusal(), Contains("meshes[0].primitives[0].indices: index 5 at 1 exceeds the 5 vertices"));

  GltfFile nan;
  CHECK_THAT(point(nan, nan.floats({0, NAN, 0}, "VEC3", 3)).refusal(), Contains("POSITION: element 0 must be finite"));
  GltfFile infinite;
  CHECK_THAT(point(infinite, infinite.floats({0, 0, 0, 0, 0, -INFINITY}, "VEC3", 3)).refusal(),
             Contains("POSITION: element 1 must be finite"));
  GltfFile bytes; // without KHR_mesh_quantization
  CHECK_THAT(point(bytes, bytes.accessor(bytes.view(std::vector<std::int8_t>{1, 2, 3, 0}), kByte, "VEC3", 1)).refusal(),
             Contains("attributes.POSITION"));
}

TEST_CASE("A tiny file cannot ask for endless memory", "[scene][gltf]") {
  GltfFile file;
  const int zeros = file.accessor(-1, kFloat, "VEC3", 4000000000U);
  CHECK_THAT(point(file, zeros).refusal(), Catch::Contains("MiB"));

  GltfFile many; // each of 4000 primitives is a million zeros
  const int million = many.accessor(-1, kFloat, "VEC3", 1000000);
  const nlohmann::json primitive = {{"attributes", {{"POSITION", million}}}, {"mode", 0}};
  many.json["meshes"] = {{{"primitives", std::vector<nlohmann::json>(4000, primitive)}}};
  CHECK_THAT(many.refusal(), Catch::Contains("MiB"));
}

TEST_CASE("Bounds are those of the triangles in a pose", "[scene]") {
  const host::Scene scene = everything().load();
  const host::Bounds bounds = host::boundsOf(scene, host::poseAt(scene, 0));
  // The square, scaled by 2 and moved up by 1, with its sparse corner at y = 2; the strip at (5, 6, 7).
  CHECK(bounds.low == glm::dvec3(0, 1, 0));
  CHECK(bounds.high == glm::dvec3(12, 15, 14));
  CHECK(host::boundsOf(host::Scene{}, {}).high == glm::dvec3(0));
}

TEST_CASE("A buffer in base64 is read with and without padding, and nothing else for base64", "[scene][gltf]") {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    GltfFile file;
    file.json["buffers"][0] = {{"byteLength", 48}, {"uri", "data:application/octet-stream;base64," + text}};
    file.json["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 48}};
    file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    file.show({{"attributes", {{"POSITION", file.accessor(0, kUnsignedByte, "VEC3", 16)}}}, {"mode", 0}});
    const std::string json = file.json.dump();
    writeBytes(folder / "a.gltf", {json.begin(), json.end()});
    return host::loadScene(folder / "a.gltf");
  };
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (const char* rest : {"", "AA==", "AA", "AAA=", "AAA", "AAAA"}) {
    CAPTURE(rest);
    const auto vertices = load(digits + rest).meshes.at(0).primitives.at(0).vertices;
    for (std::uint32_t i = 0; i < 16; ++i) {
      const std::uint32_t bits = (4 * i) << 18 | (4 * i + 1) << 12 | (4 * i + 2) << 6 | (4 * i + 3);
      CHECK(vertices.at(i).position == glm::vec3(bits >> 16, bits >> 8 & 0xff, bits & 0xff));
    }
  }
  using Catch::Contains;
  CHECK_THROWS_WITH(load(digits + "A*AA"), Contains("buffers[0].uri") && Contains("base64 does not have"));
  CHECK_THROWS_WITH(load(digits + "AA==AAAA"), Contains("base64 does not have"));
  CHECK_THROWS_WITH(load("===="), Contains("no base64 data"));
  CHECK_THROWS_WITH(load(digits.substr(0, 63)), Contains("there are 47 bytes"));
}

} // namespace tests
