#include "gl/ReadBack.h"
#include "gl/SceneRenderer.h"
#include "gl/host/SmallScenes.h"
#include "scene/Error.h"
#include "support/Catch.h"
#include "support/TestContext.h"

#include <algorithm>

using host::ClipConvention;
using tests::addWall;
using tests::restPose;

namespace {

constexpr int kSide = 16;

/// Renders a wall at each distance, nearest of all first and last, and returns the depth in the middle and in a corner.
struct Depths {
  float middle = 0;
  float corner = 0;
};

Depths renderWalls(const tyndall::Camera& camera, int samples = 1) {
  host::Scene scene = tests::emptyScene();
  addWall(scene, -2.5, 0.5F);
  addWall(scene, -7, 1);
  host::SceneRenderer renderer(scene);
  host::RenderTargets targets({kSide, kSide, GL_RGBA32F, GL_DEPTH_COMPONENT32F, samples});
  renderer.renderScene(restPose(scene), camera, {}, targets, glm::vec3(0.25F, 0.5F, 1));
  const std::vector<float> colour = host::readColour(targets.colour(), kSide, kSide);
  CHECK(std::vector<float>(colour.begin(), colour.begin() + 4) == std::vector<float>{0.25F, 0.5F, 1, 1});
  if (samples > 1) {
    return {};
  }
  const std::vector<float> depth = host::readDepth(targets.depth(), kSide, kSide);
  return {depth[kSide / 2 * kSide + kSide / 2], depth[0]};
}

} // namespace

TEST_CASE("scene depth is what the projection says, in every convention", "[renderer]") {
  tests::testContext();
  for (const ClipConvention& convention : tests::allConventions()) {
    if (!tests::supports(convention)) {
      WARN("skipped: the context lacks glClipControl for " << tests::nameOf(convention));
      continue;
    }
    const std::pair<const char*, glm::dmat4> projections[] = {
        {"perspective", host::perspective(0.5, 0.5, 0.1, 50, convention)},
        {"infinite", host::perspective(0.5, 0.5, 0.1, tyndall::kInfinity, convention)},
        {"orthographic", host::orthographic(2, 2, 0.1, 50, convention)}};
    for (const auto& [name, clipFromView] : projections) {
      INFO(name << ", " << tests::nameOf(convention));
      const Depths depths = renderWalls(tests::cameraAtOrigin(clipFromView, convention.clipDepth));
      CHECK(depths.middle == Approx(tests::depthAt(clipFromView, convention.clipDepth, 2.5)).margin(3e-7));
      CHECK(depths.corner == (convention.reversed ? 0.0F : 1.0F));
    }
  }
}

TEST_CASE("the sky survives multisampling", "[renderer]") {
  tests::testContext();
  renderWalls(tests::cameraAtOrigin(host::perspective(0.5, 0.5, 0.1, 50, {})), 4);
}

TEST_CASE("a camera far from the world's origin keeps its picture", "[renderer]") {
  tests::testContext();
  const glm::dvec3 away(3.0e6, -2.0e6, 5.0e6);
  host::Scene scene = tests::emptyScene();
  tests::addQuad(scene, away + glm::dvec3(0, 0, -2.5), {0.5F, 0, 0}, {0, 0.5F, 0});
  host::SceneRenderer renderer(scene);
  host::RenderTargets targets({kSide, kSide, GL_RGBA32F});
  const glm::dmat4 clipFromView = host::perspective(0.5, 0.5, 0.1, 50, {});
  tyndall::Camera camera = tests::cameraAtOrigin(clipFromView);
  camera.viewFromWorld = host::toMat4(host::viewLooking(away, {0, 0, -1}));
  renderer.renderScene(restPose(scene), camera, {}, targets, glm::vec3(0));
  const std::vector<float> depth = host::readDepth(targets.depth(), kSide, kSide);
  CHECK(depth[kSide / 2 * kSide + kSide / 2] == Approx(tests::depthAt(clipFromView, {}, 2.5)).margin(3e-7));
}

TEST_CASE("points are drawn", "[renderer]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  scene.materials[0].emission = {1, 0, 0};
  host::Primitive primitive;
  primitive.topology = host::Topology::Points;
  const float half = 0.5F / kSide; // the middle of a pixel, in NDC
  primitive.vertices = {{{-0.5F, half, -1}}, {{half, half, -1}}, {{0.5F, half, -1}}};
  primitive.indices = {0, 2};
  scene.meshes.push_back({"points", {primitive}});
  scene.nodes.emplace_back().mesh = 0;
  host::SceneRenderer renderer(scene);
  host::RenderTargets targets({2 * kSide, 2 * kSide, GL_RGBA32F});
  renderer.renderScene(restPose(scene), tests::cameraAtOrigin(host::orthographic(1, 1, 0.1, 2, {})), {}, targets,
                       glm::vec3(0));
  const std::vector<float> red = host::readColour(targets.colour(), 2 * kSide, 2 * kSide, 1);
  CHECK(std::count(red.begin(), red.end(), 1.0F) == 2);
}

TEST_CASE("a pose must fit the scene", "[renderer]") {
  tests::testContext();
  host::Scene scene = tests::emptyScene();
  addWall(scene, -1, 1);
  host::SceneRenderer renderer(scene);
  CHECK_THROWS_WITH(renderer.drawDepthOnly({}, glm::dmat4(1)), "pose of 0 matrices: the scene has 1 nodes");
}
