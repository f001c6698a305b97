// The shared scenes and models: each loads, and has the triangles its README states.
#include "GltfFile.h"
#include "support/Catch.h"

#include <algorithm>
#include <scene/GltfLoader.h>

namespace tests {

namespace {

const std::filesystem::path kData = std::filesystem::path(TYNDALL_SHARED_DIR) / "data";

struct Counts {
  std::size_t triangles = 0;
  std::size_t lines = 0;
  std::size_t points = 0;
};

Counts countsOf(const host::Scene& scene) {
  Counts counts;
  for (const host::Mesh& mesh : scene.meshes) {
    for (const host::Primitive& primitive : mesh.primitives) {
      const std::size_t size = primitive.indices.size();
      if (primitive.topology == host::Topology::Triangles) counts.triangles += size / 3;
      if (primitive.topology == host::Topology::Lines) counts.lines += size / 2;
      if (primitive.topology == host::Topology::Points) counts.points += size;
    }
  }
  return counts;
}

bool isMissing() {
  if (std::filesystem::is_directory(kData)) return false;
  WARN("skipped: " << kData << " is absent");
  return true;
}

} // namespace

TEST_CASE("The shared scenes have the triangles their README states", "[scene][gltf][shared]") {
  if (isMissing()) return;
  const std::pair<const char*, std::size_t> files[] = {{"scenes/sponza_crytek.glb", 262267},
                                                       {"scenes/church_ctk.glb", 1230},
                                                       {"scenes/volumetric_fog_example.glb", 360},
                                                       {"scenes/godrays_demo_dirlight.glb", 360},
                                                       {"scenes/godrays_demo_pointlight.glb", 1240},
                                                       {"scenes/jungle.glb", 18515},
                                                       {"forest/CommonTree_1.glb", 2888},
                                                       {"forest/CommonTree_3.glb", 1584},
                                                       {"forest/BirchTree_1.glb", 1704},
                                                       {"forest/PineTree_1.glb", 1911},
                                                       {"forest/PineTree_3.glb", 2383},
                                                       {"forest/Bush_1.glb", 364},
                                                       {"forest/Grass.glb", 192},
                                                       {"forest/Rock_1.glb", 70},
                                                       {"models/stanford_bunny.glb", 69451},
                                                       {"models/stanford_bunny_small.glb", 3674},
                                                       {"models/stanford_dragon_res2.glb", 202520},
                                                       {"models/stanford_dragon_res4.glb", 11102},
                                                       {"terrain/jacksboro_dem.glb", 68742},
                                                       {"gltf_samples/SimpleSparseAccessor.gltf", 12},
                                                       {"gltf_samples/Cameras.gltf", 2},
                                                       {"gltf_samples/SimpleMeshes.gltf", 1},
                                                       {"gltf_samples/Cubes.glb", 36},
                                                       {"gltf_samples/CornellBox.glb", 36},
                                                       {"gltf_samples/gltf_primitives.glb", 12},
                                                       {"gltf_samples/TriangleWithoutIndices.gltf", 1}};
  for (const auto& [name, triangles] : files) {
    INFO(name);
    CHECK(countsOf(host::loadScene(kData / name)).triangles == triangles);
  }
}

TEST_CASE("Every shared sample loads", "[scene][gltf][shared]") {
  if (isMissing()) return;
  int files = 0;
  for (const char* folder : {"gltf_samples", "hair"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kData / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".glb" && extension != ".gltf") continue;
      INFO(entry.path());
      const host::Scene scene = host::loadScene(entry.path());
      const Counts counts = countsOf(scene);
      CHECK(counts.triangles + counts.lines + counts.points > 0);
      CHECK(host::poseAt(scene, 0.5).size() == scene.nodes.size());
      ++files;
    }
  }
  CHECK(files == 28);
  CHECK(countsOf(host::loadScene(kData / "hair/mohawk_lines.glb")).lines == 69068);
}

TEST_CASE("The primitive modes of the shared samples draw what they say", "[scene][gltf][shared]") {
  if (isMissing()) return;
  for (int i = 0; i < 16; ++i) {
    const std::string number = (i < 10 ? "0" : "") + std::to_string(i);
    const std::string name = "gltf_samples/Mesh_PrimitiveMode/Mesh_PrimitiveMode_" + number + ".gltf";
    INFO(name);
    const Counts counts = countsOf(host::loadScene(kData / name));
    const int mode = i < 7 ? i : std::min(i - 7, 6); // 00 to 06 without, the others with indices of several types
    CHECK(counts.points == (mode == 0 ? 1024U : 0U));
    CHECK(counts.lines == (mode >= 1 && mode <= 3 ? 4U : 0U));
    CHECK(counts.triangles == (mode >= 4 ? 2U : 0U));
  }
}

TEST_CASE("Cameras, lights and textures of the shared samples are found", "[scene][gltf][shared]") {
  if (isMissing()) return;
  const host::Scene cameras = host::loadScene(kData / "gltf_samples/Cameras.gltf");
  REQUIRE(cameras.cameras.size() == 2);
  CHECK(cameras.cameras[0].verticalFov == 0.7);
  CHECK(cameras.cameras[1].orthographic);
  const host::Scene barn = host::loadScene(kData / "scenes/volumetric_fog_example.glb");
  REQUIRE(barn.lights.size() == 1);
  CHECK(barn.lights[0].kind == tyndall::LightKind::Directional);
  const host::Scene cubes = host::loadScene(kData / "gltf_samples/Cubes.glb");
  REQUIRE(cubes.lights.size() == 1);
  CHECK(cubes.lights[0].kind == tyndall::LightKind::Point);
  const host::Scene sponza = host::loadScene(kData / "scenes/sponza_crytek.glb");
  CHECK(sponza.textures.size() == 20);
  CHECK(std::count_if(sponza.materials.begin(), sponza.materials.end(),
                      [](const host::Material& material) { return material.alphaMode == host::AlphaMode::Mask; }) == 2);
  const host::Scene box = host::loadScene(kData / "gltf_samples/BoxTextured/BoxTextured.gltf");
  const host::Scene embedded = host::loadScene(kData / "gltf_samples/BoxTextured_embedded/BoxTextured.gltf");
  REQUIRE(box.textures.size() == 1);
  CHECK(box.textures[0].width == 211);
  CHECK(embedded.textures.at(0).rgba == box.textures[0].rgba);
}

} // namespace tests
