#include "GltfFile.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <scene/GltfLoader.h>

namespace tests {

namespace {

/// A node whose `path` is animated with the given keys.
GltfFile animated(const char* path, const char* interpolation, const std::vector<float>& times,
                  const std::vector<float>& values) {
  GltfFile file;
  const bool isRotation = std::string(path) == "rotation";
  const int input = file.floats(times, "SCALAR", 1);
  const int output = isRotation ? file.floats(values, "VEC4", 4) : file.floats(values, "VEC3", 3);
  file.json["nodes"] = nlohmann::json::array({nlohmann::json::object()});
  file.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
  return file;
}

glm::dvec3 translationAt(const host::Scene& scene, double seconds) { return host::poseAt(scene, seconds).at(0)[3]; }

} // namespace

TEST_CASE("Step animation holds each key until the next", "[scene][gltf][animation]") {
  const host::Scene scene = animated("translation", "STEP", {1, 2, 4}, {1, 0, 0, 2, 0, 0, 4, 0, 0}).load();
  CHECK(translationAt(scene, 0).x == 1);
  CHECK(translationAt(scene, 1.999).x == 1);
  CHECK(translationAt(scene, 2).x == 2);
  CHECK(translationAt(scene, 3.999).x == 2);
  CHECK(translationAt(scene, 100).x == 4);
}

TEST_CASE("Linear animation interpolates and holds its ends", "[scene][gltf][animation]") {
  const host::Scene scene = animated("translation", "LINEAR", {1, 3}, {0, 0, 0, 2, 4, 8}).load();
  CHECK(translationAt(scene, 0) == glm::dvec3(0));
  CHECK(translationAt(scene, 1.5) == glm::dvec3(0.5, 1, 2));
  CHECK(translationAt(scene, 9) == glm::dvec3(2, 4, 8));
  const host::Scene scaled = animated("scale", "LINEAR", {0, 1}, {1, 1, 1, 3, 5, 7}).load();
  const glm::dmat4 pose = host::poseAt(scaled, 0.5).at(0);
  CHECK(glm::dvec3(pose[0][0], pose[1][1], pose[2][2]) == glm::dvec3(2, 3, 4));
}

TEST_CASE("Linear rotation goes along the shorter arc at even speed", "[scene][gltf][animation]") {
  // From none to 120 degrees about y; the second key's quaternion is negated, which means the same rotation.
  const auto half = static_cast<float>(std::sin(std::acos(0.5)));
  const host::Scene scene = animated("rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, -half, 0, -0.5F}).load();
  for (const double u : {0.0, 0.25, 0.5, 1.0}) {
    const glm::dvec4 x = host::poseAt(scene, u).at(0) * glm::dvec4(1, 0, 0, 0);
    const double angle = u * 2 * std::acos(0.5);
    CHECK(x.x == Approx(std::cos(angle)).margin(1e-6));
    CHECK(x.z == Approx(-std::sin(angle)).margin(1e-6));
  }
}

TEST_CASE("Cubic splines meet their keys and tangents", "[scene][gltf][animation]") {
  // x: keys 0 and 1 with tangents 0 over two seconds: 3u^2 - 2u^3. y: t^3 - t, whose tangents are -1 and 11 at 0 and 2.
  const host::Scene scene =
      animated("translation", "CUBICSPLINE", {0, 2}, {9, 9, 9, 0, 0, 0, 0, -1, 0, 0, 11, 0, 1, 6, 0, 9, 9, 9}).load();
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const double u = t / 2;
    CHECK(translationAt(scene, t).x == Approx(3 * u * u - 2 * u * u * u).margin(1e-12));
    CHECK(translationAt(scene, t).y == Approx(t * t * t - t).margin(1e-12));
  }
  CHECK(translationAt(scene, 5) == glm::dvec3(1, 6, 0));
}

TEST_CASE("Cubic rotations are normalised", "[scene][gltf][animation]") {
  const float s = std::sqrt(0.5F);
  const host::Scene scene = animated("rotation", "CUBICSPLINE", {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, //
                                                                         0, 0, 0, 0, 0, 0, s, s, 0, 0, 0, 0})
                                .load();
  const glm::dmat4 pose = host::poseAt(scene, 0.5).at(0);
  CHECK(glm::determinant(pose) == Approx(1).epsilon(1e-12));
  CHECK(pose[0][0] == Approx(std::cos(glm::radians(45.0))).epsilon(1e-6));
  CHECK(pose[0][1] == Approx(std::sin(glm::radians(45.0))).epsilon(1e-6));
}

TEST_CASE("Normalised integer rotations are decoded", "[scene][gltf][animation]") {
  GltfFile file = animated("rotation", "STEP", {0}, {0, 0, 0, 1});
  const int output = file.accessor(file.view(std::vector<std::int16_t>{0, 0, 32767, 0}), kShort, "VEC4", 1);
  file.json["accessors"][static_cast<std::size_t>(output)]["normalized"] = true;
  file.json["animations"][0]["samplers"][0]["output"] = output;
  CHECK(host::poseAt(file.load(), 0).at(0)[0][0] == Approx(-1));
}

TEST_CASE("Animations that are undefined are refused", "[scene][gltf][animation]") {
  using Catch::Contains;
  CHECK_THAT(animated("translation", "LINEAR", {1, 1}, {0, 0, 0, 0, 0, 0}).refusal(),
             Contains("animations[0].samplers[0].input: element 1"));
  CHECK_THAT(animated("translation", "LINEAR", {-1, 1}, {0, 0, 0, 0, 0, 0}).refusal(), Contains("input: element 0"));
  CHECK_THAT(animated("translation", "LINEAR", {0, NAN}, {0, 0, 0, 0, 0, 0}).refusal(), Contains("input: element 1"));
  CHECK_THAT(animated("translation", "LINEAR", {0, 1}, {0, 0, 0}).refusal(), Contains("output: has 1 elements, must"));
  CHECK_THAT(animated("translation", "LINEAR", {0}, {0, INFINITY, 0}).refusal(), Contains("output: element 0"));
  CHECK_THAT(animated("translation", "CUBICSPLINE", {0}, std::vector<float>(9, 0)).refusal(), Contains("two keys"));
  CHECK_THAT(animated("translation", "BEZIER", {0}, {0, 0, 0}).refusal(), Contains("samplers[0].interpolation"));
  CHECK_THAT(animated("rotation", "LINEAR", {0}, {0, 0, 0, 0}).refusal(),
             Contains("output: element 0 must not be zero"));
  GltfFile matrix = animated("translation", "LINEAR", {0}, {0, 0, 0});
  matrix.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK_THAT(matrix.refusal(), Contains("a node with a matrix must not be animated"));
  GltfFile twice = animated("translation", "LINEAR", {0}, {0, 0, 0});
  twice.json["animations"][0]["channels"].push_back(twice.json["animations"][0]["channels"][0]);
  CHECK_THAT(twice.refusal(), Contains("channels[1].target"));
}

} // namespace tests
