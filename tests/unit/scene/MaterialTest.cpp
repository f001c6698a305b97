#include "GltfFile.h"
#include "support/Catch.h"

#include <cmath>
#include <scene/GltfLoader.h>
#include <scene/ImageFile.h>

namespace tests {

TEST_CASE("Materials are read", "[scene][gltf]") {
  const host::Scene scene = everything().load();
  REQUIRE(scene.materials.size() == 3); // the last is the default one
  CHECK(scene.materials[0].alphaMode == host::AlphaMode::Mask);
  CHECK(scene.materials[0].alphaCutoff == 0.25F);
  CHECK(scene.materials[0].texture == 0);
  CHECK_FALSE(scene.materials[0].isGlass());
  CHECK(scene.materials[1].isGlass());
  CHECK(scene.materials[1].transmission == 0.75F);
  CHECK(scene.materials[1].baseColour == glm::vec4(1, 0.5F, 0.25F, 1));
  CHECK(scene.materials[1].emission == glm::vec3(2, 1, 0));
}

TEST_CASE("Textures are decoded top row first, with their wrap", "[scene][gltf]") {
  const host::Texture texture = everything().load().textures.at(0);
  CHECK(texture.width == 2);
  CHECK(texture.height == 2);
  CHECK(texture.rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255});
  CHECK(texture.wrapU == host::Wrap::ClampToEdge);
  CHECK(texture.wrapV == host::Wrap::MirroredRepeat);
}

TEST_CASE("A texture transform scales, then rotates, then moves", "[scene][gltf]") {
  const host::Primitive square = everything().load().meshes.at(0).primitives.at(0);
  const float c = std::cos(0.5F);
  const float s = std::sin(0.5F);
  // uv (1, 1), scaled by (2, 3), turned counter-clockwise while v points down, moved by (0.5, 0.25).
  CHECK(square.vertices[2].uv.x == Approx(0.5F + 2 * c + 3 * s));
  CHECK(square.vertices[2].uv.y == Approx(0.25F - 2 * s + 3 * c));
  CHECK(square.vertices[0].uv == glm::vec2(0.5F, 0.25F));
}

TEST_CASE("The set of texture coordinates is the material's", "[scene][gltf]") {
  GltfFile file = everything();
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"texCoord", 1}};
  const int second = file.floats({0, 0, 5, 5, 6, 6, 7, 7}, "VEC2", 2);
  CHECK(hasNote(file.load(), "TEXCOORD_1: is missing"));
  file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = second;
  CHECK(file.load().meshes[0].primitives[0].vertices[2].uv == glm::vec2(6, 6));
}

TEST_CASE("A texture that cannot be read is a note", "[scene][gltf]") {
  const auto noteFor = [](const nlohmann::json& image) {
    GltfFile file = everything();
    file.json["images"][0] = image;
    const host::Scene scene = file.load();
    CHECK(scene.materials[0].texture == -1);
    CHECK(scene.textures.empty());
    REQUIRE(hasNote(scene, "textures[0]"));
    return scene.notes.at(0);
  };
  using Catch::Contains;
  CHECK_THAT(noteFor({{"uri", "missing.png"}}), Contains("no such file"));
  CHECK_THAT(noteFor({{"uri", "../secret.png"}}), Contains("must not lead out"));
  CHECK_THAT(noteFor({{"uri", "%2e%2e/secret.png"}}), Contains("must not lead out"));
  CHECK_THAT(noteFor({{"uri", "a/..%5c..%5csecret.png"}}), Contains("must not lead out"));
  CHECK_THAT(noteFor({{"uri", "/etc/hostname"}}), Contains("absolute path"));
  CHECK_THAT(noteFor({{"uri", "%2Fetc/hostname"}}), Contains("absolute path"));
  CHECK_THAT(noteFor({{"uri", "http://localhost/a.png"}}), Contains("other schemes"));
  CHECK_THAT(noteFor({{"uri", "file:///etc/hostname"}}), Contains("other schemes"));
  CHECK_THAT(noteFor({{"uri", "a%00b.png"}}), Contains("names no file"));
  CHECK_THAT(noteFor({{"uri", "a%2.png"}}), Contains("hexadecimal"));
  CHECK_THAT(noteFor({{"uri", "."}}), Contains("not a regular file"));
  CHECK_THAT(noteFor({{"uri", "data:image/png;base64,iVBORw0KGgo="}}), Contains("cannot be read"));
  CHECK_THAT(noteFor({{"uri", "data:image/png;base64,AAAA"}}), Contains("neither PNG nor JPEG"));
  CHECK_THAT(noteFor({{"bufferView", 99}}), Contains("no such buffer view"));
  CHECK_THAT(noteFor(nlohmann::json::object()), Contains("neither uri nor bufferView"));
}

TEST_CASE("Images beside the file are found, with escapes in their names", "[scene][gltf]") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "tex");
  host::writePng(folder / "tex/red + blue.png", 2, 1, {255, 0, 0, 0, 0, 255});
  GltfFile file = everything();
  file.json["images"][0] = {{"uri", "tex/red%20+%20blue.png"}};
  writeBytes(folder / "scene.glb", file.glb());
  const host::Scene scene = host::loadScene(folder / "scene.glb");
  REQUIRE(scene.textures.size() == 1);
  CHECK(scene.textures[0].rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255});
}

TEST_CASE("Broken looks are notes, not errors", "[scene][gltf]") {
  GltfFile file = everything();
  file.json["materials"][0]["alphaMode"] = "GLITTER";
  file.json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] = {2, 0.5, -1, 1};
  file.json["textures"][0]["sampler"] = 7;
  file.json["meshes"][1]["primitives"][0]["material"] = 9;
  file.json["extensionsUsed"].push_back("KHR_materials_sheen");
  file.json["extensionsRequired"].push_back("KHR_materials_sheen");
  const host::Scene scene = file.load();
  CHECK(scene.materials[0].alphaMode == host::AlphaMode::Opaque);
  CHECK(scene.materials[1].baseColour == glm::vec4(1, 0.5F, 0, 1));
  CHECK(scene.textures.at(0).wrapU == host::Wrap::Repeat);
  CHECK(scene.meshes[1].primitives[0].material == 2);
  CHECK(hasNote(scene, "materials[0].alphaMode"));
  CHECK(hasNote(scene, "materials[1].pbrMetallicRoughness.baseColorFactor"));
  CHECK(hasNote(scene, "textures[0].sampler"));
  CHECK(hasNote(scene, "meshes[1].primitives[0].material"));
  CHECK(hasNote(scene, "KHR_materials_sheen is ignored"));
}

} // namespace tests
