// Banks of fog: what a file says of them, where they are and what fills them.
#include "GltfFile.h"
#include "support/Catch.h"

#include <algorithm>
#include <numeric>
#include <scene/Fog.h>

namespace {

tests::GltfFile fogFile(const nlohmann::json& fog) {
  tests::GltfFile file;
  file.json["nodes"] = {{{"translation", {1, 2, 3}}, {"scale", {4, 1, 2}}, {"extras", {{"tyndall", {{"fog", fog}}}}}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  return file;
}

} // namespace

TEST_CASE("Banks of fog are read from nodes, what they scatter from the scene", "[scene][fog]") {
  tests::GltfFile file = fogFile(
      {{"shape", "sphere"}, {"extinction", 0.25}, {"fade", 1}, {"billows", {3, 1, 2}}, {"clear", 0.5}, {"seed", 9}});
  file.json["scenes"][0]["extras"]["tyndall"]["fog"] = {{"albedo", {0.5, 0.25, 1}}, {"g", -0.5}};
  const host::Scene scene = file.load();
  REQUIRE(scene.fog.size() == 1);
  const host::FogBank& bank = scene.fog[0];
  CHECK(bank.sphere);
  CHECK(bank.extinction == 0.25);
  CHECK(bank.fade == 1);
  CHECK(bank.billows == glm::ivec3(3, 1, 2));
  CHECK(bank.clear == 0.5);
  CHECK(bank.seed == 9);
  REQUIRE(scene.fogScattering);
  CHECK(scene.fogScattering->albedo == tyndall::Rgb{0.5F, 0.25F, 1});
  CHECK(scene.fogScattering->g == -0.5F);
  const std::vector<host::Bounds> bounds = host::fogBounds(scene, host::poseAt(scene, 0));
  REQUIRE(bounds.size() == 1);
  CHECK(bounds[0].low == glm::dvec3(-3, 1, 1));
  CHECK(bounds[0].high == glm::dvec3(5, 3, 5));
  const host::Scene plain = fogFile(nlohmann::json::object()).load();
  CHECK_FALSE(plain.fog.at(0).sphere);
  CHECK(host::fogGrid(plain.fog[0]).size == glm::ivec3(0));
}

TEST_CASE("Fog that breaks a rule is refused, the field named", "[scene][fog]") {
  using Catch::Contains;
  const auto check = [](const nlohmann::json& fog, const std::string& part) {
    CAPTURE(fog.dump());
    CHECK_THAT(fogFile(fog).refusal(), Contains("extras.tyndall.fog" + part));
  };
  check({{"shape", "cone"}}, ".shape: must be box or sphere");
  check({{"extinction", -1}}, ".extinction: must be at least 0");
  check({{"fade", 1.5}}, ".fade: must be at least 0 and at most 1");
  check({{"billows", {0, 1, 1}}}, ".billows: must be 3 whole numbers from 1 to 32");
  check({{"billows", {1, 1.5, 1}}}, ".billows: must be 3 whole numbers from 1 to 32");
  check({{"billows", {1, 1, 33}}}, ".billows: must be 3 whole numbers from 1 to 32");
  check({{"clear", 2}}, ".clear");
  check({{"seed", -1}}, ".seed");
  check({{"wind", 1}}, ".wind: is unknown");
  tests::GltfFile both = fogFile(nlohmann::json::object());
  both.json["nodes"][0]["extras"]["tyndall"]["smoke"] = nlohmann::json::object();
  CHECK_THAT(both.refusal(), Contains("fog: a scene has smoke or banks of fog, not both"));
  tests::GltfFile many = fogFile(nlohmann::json::object());
  for (int i = 1; i < 9; ++i) {
    many.json["nodes"].push_back(many.json["nodes"][0]);
    many.json["scenes"][0]["nodes"].push_back(i);
  }
  CHECK_THAT(many.refusal(), Contains("nodes[8].extras.tyndall.fog: a scene has at most 8 banks of fog"));
  tests::GltfFile bright = fogFile(nlohmann::json::object());
  bright.json["scenes"][0]["extras"]["tyndall"]["fog"] = {{"albedo", {1, 2, 1}}};
  CHECK_THAT(bright.refusal(), Contains("extras.tyndall.fog.albedo: must be 3 numbers from 0 to 1"));
}

TEST_CASE("Billows follow their seed, and are clear by about the share that is asked for", "[scene][fog]") {
  host::FogBank bank;
  bank.billows = {4, 2, 3};
  const host::FogGrid grid = host::fogGrid(bank);
  CHECK(grid.size == glm::ivec3(48, 24, 36));
  REQUIRE(grid.values.size() == std::size_t{48} * 24 * 36);
  CHECK(host::fogGrid(bank).values == grid.values);
  bank.seed = 1;
  CHECK(host::fogGrid(bank).values != grid.values);
  const auto meanOf = [&](double clear) {
    bank.clear = clear;
    const std::vector<std::uint8_t> values = host::fogGrid(bank).values;
    return std::accumulate(values.begin(), values.end(), 0.0) / (255.0 * static_cast<double>(values.size()));
  };
  CHECK(meanOf(0) > meanOf(0.3));
  CHECK(meanOf(0.3) > meanOf(0.6));
  CHECK(meanOf(0) > 0.5);
  CHECK(meanOf(0.6) < 0.3);
}
