// Scene files: a .glb where the bytes begin as one, else a .gltf.
#include "Fuzz.h"
#include "unit/scene/SceneRules.h"

#include <scene/Error.h>
#include <scene/GltfLoader.h>
#include <scene/WorldGeometry.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool isBinary = size >= 4 && std::memcmp(data, "glTF", 4) == 0;
  const std::filesystem::path file = fuzz::fileOf(isBinary ? "input.glb" : "input.gltf", data, size);
  fuzz::accepts<host::Error>([&] {
    const host::Scene scene = host::loadScene(file);
    const std::string broken = tests::brokenRuleOf(scene);
    fuzz::require(broken.empty(), broken);
    host::boundsOf(scene, host::poseAt(scene, 0.25));
  });
  return 0;
}
