#include "GltfFile.h"
#include "support/Catch.h"

#include <scene/GltfLoader.h>

namespace tests {

namespace {

std::string refusal(const std::string& path, const nlohmann::json& value) {
  GltfFile file = everything();
  file.json[nlohmann::json::json_pointer(path)] = value;
  return file.refusal();
}

const std::string kLens = "/cameras/0/perspective/";
const std::string kOrthographic = "/cameras/1/orthographic/";
const std::string kLights = "/extensions/KHR_lights_punctual/lights/";

} // namespace

TEST_CASE("Cameras are read", "[scene][gltf]") {
  GltfFile file = everything();
  host::Scene scene = file.load();
  REQUIRE(scene.cameras.size() == 2);
  CHECK_FALSE(scene.cameras[0].orthographic);
  CHECK(scene.cameras[0].verticalFov == 0.7);
  CHECK(scene.cameras[0].nearPlane == 0.1);
  CHECK(scene.cameras[0].farPlane == 100);
  CHECK(scene.cameras[1].orthographic);
  CHECK(scene.cameras[1].halfHeight == 1.5);
  CHECK(scene.cameras[1].farPlane == 50);
  file.json["cameras"][0]["perspective"].erase("zfar");
  CHECK(file.load().cameras[0].farPlane == 0);
}

TEST_CASE("Cameras that are undefined are refused", "[scene][gltf]") {
  using Catch::Contains;
  for (const double yfov : {0.0, -1.0, 3.15}) {
    CHECK_THAT(refusal(kLens + "yfov", yfov), Contains("cameras[0].perspective.yfov"));
  }
  CHECK_THAT(refusal(kLens + "yfov", "0.7"), Contains("cameras[0].perspective.yfov: must be a number"));
  CHECK_THAT(refusal(kLens + "znear", 0), Contains("cameras[0].perspective.znear"));
  CHECK_THAT(refusal(kLens + "zfar", 0.1), Contains("cameras[0].perspective.zfar"));
  CHECK_THAT(refusal(kOrthographic + "xmag", 0), Contains("cameras[1].orthographic.xmag"));
  CHECK_THAT(refusal(kOrthographic + "ymag", 0), Contains("cameras[1].orthographic.ymag"));
  CHECK_THAT(refusal(kOrthographic + "znear", -1), Contains("cameras[1].orthographic.znear"));
  CHECK_THAT(refusal(kOrthographic + "zfar", 0), Contains("cameras[1].orthographic.zfar"));
  CHECK_THAT(refusal("/cameras/0/type", "fisheye"), Contains("cameras[0].type"));
  CHECK_THAT(refusal("/nodes/3/camera", 2), Contains("nodes[3].camera"));
}

TEST_CASE("Punctual lights are read", "[scene][gltf]") {
  const host::Scene scene = everything().load();
  REQUIRE(scene.lights.size() == 3);
  CHECK(scene.lights[0].kind == tyndall::LightKind::Directional);
  CHECK(scene.lights[0].colour == glm::vec3(4, 2, 1));
  CHECK(scene.lights[0].range == tyndall::kInfinity);
  CHECK(scene.lights[1].kind == tyndall::LightKind::Point);
  CHECK(scene.lights[1].range == 10);
  CHECK(scene.lights[1].colour == glm::vec3(1));
  CHECK(scene.lights[2].kind == tyndall::LightKind::Spot);
  CHECK(scene.lights[2].innerConeAngle == 0.25);
  CHECK(scene.lights[2].outerConeAngle == 0.5);
  int found = 0;
  for (const host::Node& node : scene.nodes) {
    found += node.light >= 0 ? 1 : 0;
  }
  CHECK(found == 3);
}

TEST_CASE("Lights that are undefined are refused", "[scene][gltf]") {
  using Catch::Contains;
  CHECK_THAT(refusal(kLights + "0/intensity", -1), Contains("lights[0].intensity"));
  CHECK_THAT(refusal(kLights + "0/intensity", 1e300), Contains("lights[0].intensity"));
  CHECK_THAT(refusal(kLights + "0/color/1", -0.5), Contains("lights[0].color"));
  CHECK_THAT(refusal(kLights + "0/color", {1, 1}), Contains("lights[0].color: must be 3 numbers"));
  CHECK_THAT(refusal(kLights + "1/range", 0), Contains("lights[1].range"));
  CHECK_THAT(refusal(kLights + "2/spot/innerConeAngle", 0.6), Contains("lights[2].spot.innerConeAngle"));
  CHECK_THAT(refusal(kLights + "2/spot/innerConeAngle", -0.1), Contains("lights[2].spot.innerConeAngle"));
  CHECK_THAT(refusal(kLights + "2/spot/outerConeAngle", 1.58), Contains("lights[2].spot.outerConeAngle"));
  CHECK_THAT(refusal(kLights + "2/type", "area"), Contains("lights[2].type"));
  CHECK_THAT(refusal("/nodes/3/extensions/KHR_lights_punctual/light", 3), Contains("nodes[3].extensions"));
}

TEST_CASE("A right angle stored as a float is one", "[scene][gltf]") {
  GltfFile file = everything();
  file.json["extensions"]["KHR_lights_punctual"]["lights"][2]["spot"]["outerConeAngle"] = 1.5707963705062866;
  CHECK(file.load().lights[2].outerConeAngle <= 1.5707963267948966);
}

} // namespace tests
