// The animated sample scene, as its generator wrote it and the loader reads it.
#include "support/Catch.h"

#include <algorithm>
#include <scene/GltfLoader.h>

TEST_CASE("The orrery turns in a loop of 300 frames within its hall", "[scene][gltf][animation]") {
  const host::Scene scene = host::loadScene(std::string(TYNDALL_SCENES_DIR) + "/orrery.glb");
  CHECK(scene.notes.empty());
  CHECK(scene.meshes.size() == 13); // the hall and twelve bodies
  CHECK(scene.animation.size() == 24);
  for (const host::AnimationChannel& channel : scene.animation) {
    CHECK(channel.interpolation == host::Interpolation::Linear);
    CHECK(channel.times.size() == 301);
    CHECK(channel.times.front() == 0);
    CHECK(channel.times.back() == 12.5F);
    CHECK(channel.values.front() == channel.values.back());
  }
  CHECK(std::any_of(scene.meshes.begin(), scene.meshes.end(),
                    [](const host::Mesh& mesh) { return mesh.primitives[0].indices.size() > 3 * 500000; }));

  const host::Bounds still = host::boundsOf(scene, host::poseAt(scene, 0));
  for (int frame = 20; frame < 300; frame += 20) {
    const std::vector<glm::dmat4> pose = host::poseAt(scene, frame / 24.0);
    CHECK(pose != host::poseAt(scene, (frame - 1) / 24.0));
    const host::Bounds bounds = host::boundsOf(scene, pose);
    CHECK(bounds.low == still.low);
    CHECK(bounds.high == still.high);
  }
}
