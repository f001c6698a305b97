#include "ViewScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/Error.h>
#include <scene/Projection.h>
#include <scene/View.h>

namespace {

constexpr double kAspect = 1.5;

glm::dvec3 ndcOf(const tyndall::Camera& camera, const glm::dvec3& world) {
  const glm::dvec4 clip =
      host::fromMat4(camera.clipFromView) * host::fromMat4(camera.viewFromWorld) * glm::dvec4(world, 1);
  return glm::dvec3(clip) / clip.w;
}

/// Node 0 holds no camera, node 1 a perspective one, node 2 an orthographic one.
host::Scene sceneWithCameras() {
  host::Scene scene = tests::sceneOf(tests::box({-1, -1, -1}, {1, 1, 1}));
  scene.cameras.resize(2);
  scene.cameras[0].verticalFov = 1.1;
  scene.cameras[0].nearPlane = 0.5;
  scene.cameras[1].orthographic = true;
  scene.cameras[1].halfHeight = 4;
  scene.cameras[1].nearPlane = 1;
  scene.cameras[1].farPlane = 21;
  scene.nodes.resize(3);
  scene.nodes[1].camera = 0;
  scene.nodes[2].camera = 1;
  return scene;
}

const glm::dmat4 kCameraPose = glm::translate(glm::dmat4(1), {2, 3, 10}) * glm::rotate(glm::dmat4(1), 0.4, {1, 2, 3});

host::Scene sceneWithLights(int count) {
  host::Scene scene;
  scene.materials.emplace_back();
  scene.lights.resize(1);
  scene.lights[0].kind = tyndall::LightKind::Spot;
  scene.lights[0].colour = {1, 2, 3};
  scene.lights[0].range = 7;
  scene.lights[0].innerConeAngle = 0.2;
  scene.lights[0].outerConeAngle = 0.6;
  scene.nodes.resize(count);
  for (host::Node& node : scene.nodes)
    node.light = 0;
  return scene;
}

} // namespace

TEST_CASE("a perspective glTF camera keeps its vertical angle and may see without end") {
  host::Scene scene = sceneWithCameras();
  const tests::Pose pose = {glm::dmat4(1), kCameraPose, glm::dmat4(1)};
  const tyndall::Camera camera = host::makeCamera(scene, pose, 0, kAspect);
  const double tangent = std::tan(0.55);
  const auto at = [&](double x, double y, double z) {
    return ndcOf(camera, glm::dvec3(kCameraPose * glm::dvec4(x, y, z, 1)));
  };
  CHECK(glm::length(at(0, 0, -0.5) - glm::dvec3(0, 0, -1)) < 1e-12);
  CHECK(glm::length(at(kAspect * tangent * 8, -tangent * 8, -8) - glm::dvec3(1, -1, at(0, 0, -8).z)) < 1e-12);
  CHECK(at(0, 0, -1e12).z == Approx(1));
  CHECK(at(0, 0, -1e12).z < 1);

  scene.cameras[0].farPlane = 40;
  const tyndall::Camera finite = host::makeCamera(scene, pose, 0, kAspect, {true, tyndall::ClipDepth::ZeroToOne});
  CHECK(finite.clipDepth == tyndall::ClipDepth::ZeroToOne);
  CHECK(ndcOf(finite, glm::dvec3(kCameraPose * glm::dvec4(0, 0, -0.5, 1))).z == Approx(1));
  CHECK(ndcOf(finite, glm::dvec3(kCameraPose * glm::dvec4(0, 0, -40, 1))).z == Approx(0).margin(1e-12));
}

TEST_CASE("an orthographic glTF camera keeps its height") {
  const tests::Pose pose = {glm::dmat4(1), glm::dmat4(1), kCameraPose};
  const tyndall::Camera camera = host::makeCamera(sceneWithCameras(), pose, 1, kAspect);
  const auto at = [&](double x, double y, double z) {
    return ndcOf(camera, glm::dvec3(kCameraPose * glm::dvec4(x, y, z, 1)));
  };
  CHECK(glm::length(at(4 * kAspect, 4, -1) - glm::dvec3(1, 1, -1)) < 1e-12);
  CHECK(glm::length(at(-4 * kAspect, -4, -21) - glm::dvec3(-1, -1, 1)) < 1e-12);
}

TEST_CASE("a camera node's scale, mirroring too, leaves the view rigid") {
  const host::Scene scene = sceneWithCameras();
  const tyndall::Camera plain = host::makeCamera(scene, {glm::dmat4(1), kCameraPose, glm::dmat4(1)}, 0, 1);
  for (const glm::dvec3 scale : {glm::dvec3(0.01), glm::dvec3(3, 1, 7), glm::dvec3(-2, 1, 1)}) {
    const tests::Pose pose = {glm::dmat4(1), kCameraPose * glm::scale(glm::dmat4(1), scale), glm::dmat4(1)};
    const tyndall::Camera camera = host::makeCamera(scene, pose, 0, 1);
    for (int i = 0; i < 16; ++i)
      CHECK(camera.viewFromWorld[i] == Approx(plain.viewFromWorld[i]).margin(1e-12));
  }
}

TEST_CASE("cameras that cannot be") {
  const host::Scene scene = sceneWithCameras();
  const tests::Pose pose = tests::restPose(scene);
  CHECK_THROWS_WITH(host::makeCamera(scene, pose, 2, 1), "camera 2: must be 0 to 1, the scene's cameras");
  CHECK_THROWS_AS(host::makeCamera(scene, pose, -1, 1), host::Error);
  CHECK_THROWS_AS(host::makeCamera(scene, {glm::dmat4(1), glm::dmat4(0), glm::dmat4(1)}, 0, 1), host::Error);
  CHECK_THROWS_AS(host::makeLookAt(scene, pose, {1, 1, 1}, {1, 1, 1}, 50, 1), host::Error);
  host::Scene none = scene;
  none.nodes.resize(1);
  CHECK_THROWS_WITH(host::makeCamera(none, pose, 0, 1), "camera 0: the scene has no camera");
}

TEST_CASE("a look-at camera has its target in the middle and its planes around what it sees") {
  const host::Scene scene = sceneWithCameras();
  const tests::Pose pose = tests::restPose(scene);
  const tyndall::Camera camera = host::makeLookAt(scene, pose, {0, 0, 11}, {0, 0, 1}, 60, kAspect);
  CHECK(glm::length(glm::dvec2(ndcOf(camera, {0, 0, 1}))) < 1e-12);
  CHECK(ndcOf(camera, {0, 10 * std::tan(3.14159265358979323846 / 6), 1}).y == Approx(1));
  const double nearest = ndcOf(camera, {0, 0, 1}).z;
  const double farthest = ndcOf(camera, {0, 0, -1}).z;
  CHECK(nearest > -1);
  CHECK(nearest < -0.8);
  CHECK(farthest > 0.8);
  CHECK(farthest < 1);
}

TEST_CASE("the default camera shows all of a solid thing and says so") {
  const host::Scene scene = tests::sceneOf(tests::box({-2, 0, -1}, {2, 5, 1}));
  for (const double aspect : {0.4, 1.0, 2.5}) {
    host::Notes notes;
    const tyndall::Camera camera = host::makeDefaultCamera(scene, tests::restPose(scene), aspect, {}, notes);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("scene has no camera: looking from ") == 0);
    for (const glm::vec3& corner : tests::box({-2, 0, -1}, {2, 5, 1})) {
      const glm::dvec3 ndc = ndcOf(camera, corner);
      CHECK(std::max({std::abs(ndc.x), std::abs(ndc.y), std::abs(ndc.z)}) <= 1);
    }
  }
}

TEST_CASE("the default camera stands inside a closed room") {
  std::vector<glm::vec3> corners = tests::box({-10, 0, -3}, {10, 4, 3});
  for (std::size_t i = 0; i < corners.size(); i += 3)
    std::swap(corners[i], corners[i + 1]);
  host::Scene scene = tests::sceneOf(corners);
  const bool isOutward = GENERATE(false, true);
  if (isOutward) {
    scene = tests::sceneOf(tests::box({-10, 0, -3}, {10, 4, 3}));
    scene.materials.emplace_back();
    scene.materials.back().alphaMode = host::AlphaMode::Blend;
  }
  host::Notes notes;
  const tyndall::Camera camera = host::makeDefaultCamera(scene, tests::restPose(scene), kAspect, {}, notes);
  const glm::dvec3 eye(glm::inverse(host::fromMat4(camera.viewFromWorld))[3]);
  CHECK(glm::distance(eye, {9, 2, 0}) < 1e-9);
  CHECK(glm::length(glm::dvec2(ndcOf(camera, {-10, 2, 0}))) < 1e-9);

  const std::vector<tyndall::Light> lights = {host::makeSun({0, -1, 0})};
  const glm::vec3 indoors = host::skyOf(scene, tests::restPose(scene), lights, notes);
  const glm::vec3 outdoors = host::skyOf({}, {}, lights, notes);
  CHECK(indoors.g < 0.2F * outdoors.g);
}

TEST_CASE("an empty scene has a default camera, sun and medium") {
  host::Scene scene;
  host::Notes notes;
  const tyndall::Camera camera = host::makeDefaultCamera(scene, {}, 1, {}, notes);
  for (const double element : camera.viewFromWorld)
    CHECK(std::isfinite(element));
  const std::vector<tyndall::Light> lights = host::makeLights(scene, {}, notes);
  CHECK(lights.size() == 1);
  CHECK(std::isfinite(host::mediumOf(scene, {}, notes).constituents.at(0).scattering[0]));
  CHECK(glm::length(host::skyOf(scene, {}, lights, notes)) > 0);
  CHECK(notes.size() == 4);
}

TEST_CASE("a scene without a sky gets one as bright as its suns make it, or a black one under lamps") {
  host::Notes notes;
  host::Scene scene = sceneWithLights(2);
  const auto sky = [&] {
    const tests::Pose pose = tests::restPose(scene);
    return host::skyOf(scene, pose, host::makeLights(scene, pose, notes), notes);
  };
  CHECK(sky() == glm::vec3(0));
  CHECK(notes.empty());

  scene.lights[0].kind = tyndall::LightKind::Directional;
  const glm::vec3 one = sky();
  CHECK(std::min({one.r, one.g, one.b}) > 0);
  CHECK(std::max({one.r, one.g, one.b}) < 1);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("scene has no sky") == 0);
  scene.lights[0].colour *= 7.0F;
  CHECK(glm::distance(sky(), 7.0F * one) < 1e-5F * glm::length(one));

  notes.clear();
  scene.skyRadiance = {1, 2, 3};
  CHECK(sky() == glm::vec3(1, 2, 3));
  CHECK(notes.empty());
}

TEST_CASE("lights stand and shine where their nodes do") {
  const host::Scene scene = sceneWithLights(1);
  host::Notes notes;
  const std::vector<tyndall::Light> lights =
      host::makeLights(scene, {kCameraPose * glm::scale(glm::dmat4(1), glm::dvec3(5))}, notes);
  REQUIRE(lights.size() == 1);
  CHECK(notes.empty());
  CHECK(lights[0].kind == tyndall::LightKind::Spot);
  CHECK(lights[0].position == tyndall::Vec3{2, 3, 10});
  const glm::dvec3 expected = -glm::dvec3(kCameraPose[2]);
  for (int i = 0; i < 3; ++i)
    CHECK(lights[0].direction[i] == Approx(expected[i]));
  CHECK(lights[0].colour == tyndall::Rgb{1, 2, 3});
  CHECK(lights[0].range == 7);
  CHECK(lights[0].innerConeAngle == 0.2);
  CHECK(lights[0].outerConeAngle == 0.6);
}

TEST_CASE("more lights than the effect takes are left out with a note") {
  const host::Scene scene = sceneWithLights(tyndall::kMaxLights + 3);
  host::Notes notes;
  CHECK(host::makeLights(scene, tests::restPose(scene), notes).size() == tyndall::kMaxLights);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("last 3") != std::string::npos);
}

TEST_CASE("a light on a squashed node is refused unless it shines everywhere") {
  host::Scene scene = sceneWithLights(1);
  host::Notes notes;
  CHECK_THROWS_AS(host::makeLights(scene, {glm::dmat4(0)}, notes), host::Error);
  scene.lights[0].kind = tyndall::LightKind::Point;
  CHECK(host::makeLights(scene, {glm::dmat4(0)}, notes).size() == 1);
}

TEST_CASE("the default medium lets three quarters through the bounds' diagonal, whatever the unit") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    host::Notes notes;
    const tyndall::Medium medium = host::mediumOf({}, {glm::dvec3(0), scale * glm::dvec3(3, 4, 12)}, notes);
    REQUIRE(medium.constituents.size() == 1);
    const double extinction = medium.constituents[0].scattering[1] + medium.absorption[1];
    CHECK(std::exp(-extinction * 13 * scale) == Approx(0.75).epsilon(1e-6));
    CHECK(medium.farDistance == Approx(2 * 13 * scale));
    CHECK(notes.size() == 1);
  }
  host::Scene scene;
  scene.medium = tyndall::Medium{};
  scene.medium->absorption = {1, 2, 3};
  host::Notes notes;
  CHECK(host::mediumOf(scene, {}, notes).absorption == tyndall::Rgb{1, 2, 3});
  CHECK(notes.empty());
}
