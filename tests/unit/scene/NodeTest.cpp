#include "GltfFile.h"
#include "support/Catch.h"

#include <scene/Error.h>
#include <scene/GltfLoader.h>

namespace tests {

namespace {

GltfFile withNodes(const nlohmann::json& nodes) {
  GltfFile file;
  file.json["nodes"] = nodes;
  return file;
}

} // namespace

TEST_CASE("Parents come before children and transforms compose", "[scene][gltf]") {
  // In the file the child comes first.
  const host::Scene scene = withNodes({{{"name", "child"}, {"translation", {1, 0, 0}}},
                                       {{"name", "parent"},
                                        {"children", {0}},
                                        {"rotation", {0, 0, 0.7071067811865476, 0.7071067811865476}},
                                        {"scale", {2, 2, 2}},
                                        {"translation", {0, 0, 3}}}})
                                .load();
  REQUIRE(scene.nodes.size() == 2);
  CHECK(scene.nodes[0].name == "parent");
  CHECK(scene.nodes[1].parent == 0);
  const glm::dvec4 origin = host::poseAt(scene, 0)[1] * glm::dvec4(0, 0, 0, 1);
  CHECK(origin.x == Approx(0).margin(1e-12));
  CHECK(origin.y == Approx(2));
  CHECK(origin.z == Approx(3));
}

TEST_CASE("A matrix replaces translation, rotation and scale", "[scene][gltf]") {
  const host::Scene scene = withNodes({{{"matrix", {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}}}).load();
  CHECK(host::poseAt(scene, 0).at(0) * glm::dvec4(1, 1, 1, 1) == glm::dvec4(7, 9, 11, 1));
}

TEST_CASE("Only the nodes of the scene survive", "[scene][gltf]") {
  GltfFile file = withNodes({{{"name", "a"}}, {{"name", "b"}, {"children", {2}}}, {{"name", "c"}}});
  CHECK(file.load().nodes.size() == 3);
  CHECK(hasNote(file.load(), "scenes: there are none"));
  file.json["scenes"] = {{{"nodes", {0}}}, {{"name", "second"}, {"nodes", {1}}}};
  CHECK(file.load().nodes.at(0).name == "a");
  CHECK(file.load().nodes.size() == 1);
  file.json["scene"] = 1;
  const host::Scene second = file.load();
  CHECK(second.name == "second");
  REQUIRE(second.nodes.size() == 2);
  CHECK(second.nodes[0].name == "b");
  CHECK(second.nodes[1].name == "c");
}

TEST_CASE("A long chain of nodes needs no deep stack", "[scene][gltf]") {
  constexpr std::size_t kLength = 100000;
  nlohmann::json nodes = nlohmann::json::array();
  for (std::size_t i = 0; i < kLength; ++i) {
    nlohmann::json node = nlohmann::json::object();
    if (i + 1 < kLength) node["children"] = {i + 1};
    nodes.push_back(std::move(node));
  }
  CHECK(withNodes(nodes).load().nodes.size() == kLength);
}

TEST_CASE("Hierarchies that are none are refused", "[scene][gltf]") {
  using Catch::Contains;
  CHECK_THAT(withNodes({{{"children", {0}}}}).refusal(), Contains("nodes[0]: is an ancestor of itself"));
  CHECK_THAT(withNodes({{{"name", "free"}}, {{"children", {2}}}, {{"children", {1}}}}).refusal(),
             Contains("nodes[1]: is an ancestor of itself"));
  CHECK_THAT(withNodes({{{"children", {2}}}, {{"children", {2}}}, {{"name", "both"}}}).refusal(),
             Contains("nodes[1].children: nodes[2] already is a child of nodes[0]"));
  CHECK_THAT(withNodes({{{"children", {1, 1}}}, {{"name", "twice"}}}).refusal(), Contains("nodes[0].children[1]"));
  CHECK_THAT(withNodes({{{"children", {1}}}}).refusal(), Contains("nodes[0].children[0]"));
  CHECK_THAT(withNodes({{{"mesh", 0}}}).refusal(), Contains("nodes[0].mesh"));
  CHECK_THAT(withNodes({{{"rotation", {0, 0, 0, 0}}}}).refusal(), Contains("nodes[0].rotation"));
  CHECK_THAT(withNodes({{{"scale", {1, 2}}}}).refusal(), Contains("nodes[0].scale: must be 3 numbers"));
  CHECK_THAT(withNodes({{{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}).refusal(),
             Contains("nodes[0].matrix: its last row"));
  GltfFile file = withNodes({{{"children", {1}}}, {{"name", "child"}}});
  file.json["scenes"] = {{{"nodes", {1}}}};
  CHECK_THAT(file.refusal(), Contains("scenes[0].nodes[0]: must be a node without a parent"));
}

TEST_CASE("A rotation that is no unit quaternion is normalised and noted", "[scene][gltf]") {
  const host::Scene scene = withNodes({{{"rotation", {0, 0, 0, 2}}}}).load();
  CHECK(host::poseAt(scene, 0).at(0) == glm::dmat4(1));
  CHECK(hasNote(scene, "nodes[0].rotation"));
}

TEST_CASE("Medium, ambient light and sky come from the scene's extras", "[scene][gltf]") {
  const host::Scene scene = everything().load();
  REQUIRE(scene.medium.has_value());
  CHECK(scene.medium->constituents.at(0).phase == tyndall::Phase::HenyeyGreenstein);
  CHECK(scene.skyRadiance == glm::vec3(0.1F, 0.2F, 0.4F));
  CHECK_FALSE(scene.ambient.has_value());
  GltfFile wrong = everything();
  wrong.json["scenes"][0]["extras"]["tyndall"]["ambient"] = {{"radiance", {1, 2, 3}}};
  CHECK(wrong.load().ambient.value().radiance == tyndall::Rgb{1, 2, 3});
  wrong.json["scenes"][0]["extras"]["tyndall"]["ambient"]["radiance"] = {1, -2, 3};
  CHECK_THAT(wrong.refusal(), Catch::Contains("scenes[0].extras.tyndall.ambient.radiance[1]"));
  wrong = everything();
  wrong.json["scenes"][0]["extras"]["tyndall"]["sky"] = {1, 2};
  CHECK_THAT(wrong.refusal(), Catch::Contains("scenes[0].extras.tyndall.sky: must be 3 numbers"));
  wrong = everything();
  wrong.json["scenes"][0]["extras"]["tyndall"]["medium"]["absorption"] = {0, -1, 0};
  CHECK_THAT(wrong.refusal(), Catch::Contains("scenes[0].extras.tyndall.medium.absorption[1]"));
}

} // namespace tests
