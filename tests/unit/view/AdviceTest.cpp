#include "ViewScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <scene/Advice.h>
#include <scene/ShadowViews.h>

using tests::box;
using tests::restPose;
using tests::sceneOf;

namespace {

using Corners = std::vector<glm::vec3>;

/// A sphere's triangles, or of its part above a height.
Corners dome(float radius, float lowest) {
  constexpr int kRings = 8, kSides = 16;
  const auto at = [&](int ring, int side) {
    const double polar = 3.14159265358979 * ring / kRings, angle = 2 * 3.14159265358979 * side / kSides;
    return glm::vec3(radius * std::sin(polar) * std::cos(angle), std::max<double>(lowest, radius * std::cos(polar)),
                     radius * std::sin(polar) * std::sin(angle));
  };
  Corners corners;
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side)
      for (const glm::vec3& corner : {at(ring, side), at(ring + 1, side), at(ring + 1, side + 1), at(ring, side),
                                      at(ring + 1, side + 1), at(ring, side + 1)})
        corners.push_back(corner);
  return corners;
}

Corners inward(Corners corners) {
  for (std::size_t i = 0; i < corners.size(); i += 3)
    std::swap(corners[i], corners[i + 1]);
  return corners;
}

void addMesh(host::Scene& scene, const std::string& name, const Corners& corners, const host::Material& material) {
  host::Mesh mesh = sceneOf(corners).meshes[0];
  mesh.name = name;
  mesh.primitives[0].material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  scene.meshes.push_back(mesh);
  scene.nodes.emplace_back();
  scene.nodes.back().mesh = static_cast<int>(scene.meshes.size()) - 1;
}

/// A block on a floor of 40 by 40, and what is to stand around it.
host::Scene blockUnder(const Corners& around, const host::Material& material = {}) {
  host::Scene scene = sceneOf(box({-20, -1, -20}, {20, 0, 20}));
  addMesh(scene, "block", box({-1, 0, -1}, {1, 2, 1}), {});
  if (!around.empty()) addMesh(scene, "sky", around, material);
  return scene;
}

tyndall::Camera cameraOf(const host::Scene& scene) {
  return host::makeLookAt(scene, restPose(scene), {0, 2, 6}, {0, 1, 0}, 50, 1);
}

std::vector<host::Enclosure> enclosuresOf(const host::Scene& scene) {
  return host::enclosuresOf(scene, restPose(scene), cameraOf(scene), {host::makeSun({0.3, -0.8, 0.5})});
}

bool namesSky(const host::Scene& scene) {
  const std::vector<host::Enclosure> enclosures = enclosuresOf(scene);
  return enclosures.size() == 1 && enclosures[0].mesh.find("mesh \"sky\" of node 2") == 0 && enclosures[0].light == 0;
}

} // namespace

TEST_CASE("A dome around casters and camera that keeps the sun out is named", "[view][advice]") {
  CHECK(enclosuresOf(blockUnder({})).empty());
  CHECK(namesSky(blockUnder(dome(60, -60))));
  CHECK(namesSky(blockUnder(inward(dome(60, -60)))));
  CHECK(namesSky(blockUnder(box({-50, -50, -50}, {50, 50, 50}))));
  CHECK(namesSky(blockUnder(dome(15, -0.5F)))); // half a sphere over a wider floor
}

TEST_CASE("What lets the sun in is not named", "[view][advice]") {
  host::Material unlit;
  unlit.unlit = true;
  CHECK(enclosuresOf(blockUnder(dome(60, -60), unlit)).empty());
  host::Material glass;
  glass.transmission = 1;
  CHECK(enclosuresOf(blockUnder(dome(60, -60), glass)).empty());
  // A room without a roof, and one whose window lets a beam in.
  Corners walls = box({-10, 0, -10}, {10, 8, -9});
  for (const Corners& wall :
       {box({-10, 0, 9}, {10, 8, 10}), box({-10, 0, -10}, {-9, 8, 10}), box({9, 0, -10}, {10, 8, 10})})
    walls.insert(walls.end(), wall.begin(), wall.end());
  CHECK(enclosuresOf(blockUnder(walls)).empty());
  for (const Corners& roof : {box({-10, 8, -10}, {10, 9, -4}), box({-10, 8, 3}, {10, 9, 10})})
    walls.insert(walls.end(), roof.begin(), roof.end());
  CHECK(enclosuresOf(blockUnder(walls)).empty());
}

TEST_CASE("Meshes that are unlit do not stretch a shadow map", "[view][advice]") {
  host::Material unlit;
  unlit.unlit = true;
  const host::Scene with = blockUnder(dome(60, -60), unlit), without = blockUnder({});
  const auto viewsOf = [](const host::Scene& scene) {
    tyndall::Light sun = host::makeSun({0.3, -0.8, 0.5});
    const host::Scene plain = blockUnder({});
    host::fitShadowViews(sun, scene, restPose(scene), cameraOf(plain));
    REQUIRE(sun.shadow.views.size() == 1);
    return sun.shadow.views[0].clipFromWorld;
  };
  CHECK(viewsOf(with) == viewsOf(without));
}

TEST_CASE("A near plane that leaves the depth buffer no precision is noted with numbers", "[view][advice]") {
  const host::Scene scene = blockUnder({});
  const auto notesFor = [&](double nearPlane, bool reversed) {
    host::CameraOptions options;
    options.reversedDepth = reversed;
    options.clipDepth = reversed ? tyndall::ClipDepth::ZeroToOne : tyndall::ClipDepth::NegativeOneToOne;
    const tyndall::Camera camera = host::makeLookAt({0, 2, 6}, {0, 1, 0}, 50, 1, nearPlane, 100, options);
    return host::adviceOn(scene, restPose(scene), camera);
  };
  CHECK(notesFor(0.01, false).empty());
  CHECK(notesFor(1e-5, true).empty());
  const host::Notes notes = notesFor(1e-5, false);
  REQUIRE(notes.size() == 1);
  // The floor's far corners: 26 units away, known to 26 / 1e-5 / 2^25 = 7.7 %.
  CHECK(notes[0].find("near plane at 1e-05 the depth buffer holds a distance of 26") != std::string::npos);
  CHECK(notes[0].find("no better than to 7.") != std::string::npos);
}

TEST_CASE("A scene whose lengths have no squares in 32-bit floats is refused", "[view][advice]") {
  host::Scene scene = blockUnder({});
  const auto adviceAt = [&](double scale) {
    const tests::Pose pose(scene.nodes.size(), glm::dmat4(glm::dmat3(scale)));
    const tyndall::Camera camera =
        host::makeLookAt(scene, pose, scale * glm::dvec3(0, 2, 6), scale * glm::dvec3(0, 1, 0), 50, 1);
    return host::adviceOn(scene, pose, camera);
  };
  for (const double scale : {1e-15, 1e-6, 1.0, 1e6, 1e13})
    CHECK(adviceAt(scale).empty());
  for (const double scale : {1e-19, 1e15, 1e19})
    CHECK_THROWS_WITH(adviceAt(scale), Catch::Contains("units from the camera, must be 1e-16 to 1e+15"));
}
