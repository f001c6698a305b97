// Every scene that the project writes, read back: what the loader finds is what the generator described.
#include "GltfFile.h"
#include "support/Catch.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/GltfLoader.h>
#include <scenes/Generators.h>
#include <scenes/GlbWriter.h>

namespace tests {

namespace {

constexpr double kRounding = 1e-6; ///< relative, of numbers that the file holds as floats

bool isNear(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(a, b) <= kRounding * std::max(1.0, glm::length(b));
}

glm::dvec3 lookOf(const glm::dmat4& worldFromNode) { return -glm::normalize(glm::dvec3(worldFromNode[2])); }

glm::dvec3 toGlm(const tyndall::Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

/// The nodes for which `member` is set, in the order of the file.
std::vector<std::size_t> nodesWith(const host::Scene& scene, int host::Node::* member) {
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].*member >= 0) nodes.push_back(i);
  return nodes;
}

tyndall::LightKind kindOf(scenes::LightKind kind) {
  if (kind == scenes::LightKind::Point) return tyndall::LightKind::Point;
  return kind == scenes::LightKind::Spot ? tyndall::LightKind::Spot : tyndall::LightKind::Directional;
}

/// Where what carries a light is at the start.
glm::dmat4 carrierOf(const scenes::Scene& scene, const scenes::Light& light) {
  if (light.body < 0) return glm::dmat4(1);
  const scenes::Pose& pose = scene.bodies[static_cast<std::size_t>(light.body)].poses.front();
  return glm::translate(glm::dmat4(1), pose.translation) * glm::mat4_cast(pose.rotation);
}

void checkLights(const scenes::Scene& written, const host::Scene& read) {
  const std::vector<glm::dmat4> pose = host::poseAt(read, 0);
  const std::vector<std::size_t> nodes = nodesWith(read, &host::Node::light);
  REQUIRE(!written.lights.empty());
  REQUIRE(read.lights.size() == written.lights.size());
  REQUIRE(nodes.size() == written.lights.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const scenes::Light& source = written.lights[i];
    INFO(source.name);
    const host::Light& light = read.lights[static_cast<std::size_t>(read.nodes[nodes[i]].light)];
    CHECK(light.name == source.name);
    CHECK(light.kind == kindOf(source.kind));
    CHECK(isNear(light.colour, source.colour * source.intensity));
    CHECK(light.range == tyndall::kInfinity);
    const glm::dmat4 carrier = carrierOf(written, source);
    CHECK(isNear(glm::dvec3(pose[nodes[i]][3]), glm::dvec3(carrier * glm::dvec4(source.position, 1))));
    CHECK(isNear(lookOf(pose[nodes[i]]), glm::dmat3(carrier) * glm::normalize(source.direction)));
    if (source.kind != scenes::LightKind::Spot) continue;
    CHECK(light.innerConeAngle == Approx(glm::radians(source.innerConeAngle)).epsilon(1e-12));
    CHECK(light.outerConeAngle == Approx(glm::radians(source.outerConeAngle)).epsilon(1e-12));
  }
}

void checkCamera(const scenes::Camera& written, const host::Scene& read) {
  const std::vector<std::size_t> nodes = nodesWith(read, &host::Node::camera);
  REQUIRE(nodes.size() == 1);
  REQUIRE(read.cameras.size() == 1);
  const host::Camera& camera = read.cameras[0];
  const glm::dmat4 pose = host::poseAt(read, 0)[nodes[0]];
  CHECK(!camera.orthographic);
  CHECK(camera.verticalFov == Approx(glm::radians(written.verticalFov)).epsilon(1e-12));
  CHECK(camera.nearPlane == written.nearPlane);
  CHECK(camera.farPlane == written.farPlane);
  CHECK(isNear(glm::dvec3(pose[3]), written.eye));
  CHECK(isNear(lookOf(pose), glm::normalize(written.target - written.eye)));
}

void checkAir(const scenes::Scene& written, const host::Scene& read) {
  const auto phaseOf = [](const std::string& name) {
    if (name == "rayleigh") return tyndall::Phase::Rayleigh;
    if (name == "henyey-greenstein") return tyndall::Phase::HenyeyGreenstein;
    return name == "cornette-shanks" ? tyndall::Phase::CornetteShanks : tyndall::Phase::Isotropic;
  };
  REQUIRE(!written.constituents.empty());
  REQUIRE(read.medium);
  REQUIRE(read.medium->constituents.size() == written.constituents.size());
  for (std::size_t i = 0; i < written.constituents.size(); ++i) {
    const tyndall::Constituent& constituent = read.medium->constituents[i];
    CHECK(constituent.phase == phaseOf(written.constituents[i].phase));
    CHECK(constituent.g == Approx(written.constituents[i].g));
    CHECK(isNear(toGlm(constituent.scattering) * 1e6, written.constituents[i].scattering * 1e6));
  }
  CHECK(isNear(toGlm(read.medium->absorption) * 1e6, written.absorption * 1e6));
  CHECK(isNear(read.skyRadiance, written.sky));
}

/// The primitives are those of the materials in use.
void checkMaterial(const scenes::Material& written, const host::Scene& read, const host::Primitive& primitive) {
  const host::Material& material = read.materials[static_cast<std::size_t>(primitive.material)];
  CHECK(material.name == written.name);
  CHECK(isNear(glm::vec3(material.baseColour), written.colour));
  CHECK(material.baseColour.a == 1);
  CHECK(isNear(material.emission, written.emission));
  CHECK(material.alphaMode == host::AlphaMode::Opaque);
  CHECK(material.transmission == (written.glass ? 1.0F : 0.0F));
}

bool holds(const host::Primitive& primitive, const scenes::Surface& surface) {
  return primitive.topology == host::Topology::Triangles && primitive.indices == surface.indices &&
         std::equal(primitive.vertices.begin(), primitive.vertices.end(), surface.positions.begin(),
                    surface.positions.end(), [&](const host::Vertex& vertex, const glm::dvec3& position) {
                      return vertex.position == glm::vec3(position);
                    });
}

void checkMesh(const scenes::Scene& written, const std::vector<scenes::Surface>& surfaces, const host::Scene& read,
               const host::Mesh& mesh) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].indices.empty()) continue;
    REQUIRE(next < mesh.primitives.size());
    const host::Primitive& primitive = mesh.primitives[next++];
    CHECK(holds(primitive, surfaces[i]));
    checkMaterial(written.materials[i], read, primitive);
  }
  CHECK(next == mesh.primitives.size());
}

void checkPoses(const scenes::Body& body, const host::Scene& read, std::size_t node) {
  const std::size_t stride = std::max<std::size_t>(1, body.poses.size() / 10);
  for (std::size_t i = 0; i < body.poses.size(); i += stride) {
    const scenes::Pose& pose = body.poses[i];
    const glm::dmat4 placed = host::poseAt(read, static_cast<double>(static_cast<float>(pose.seconds)))[node];
    CHECK(isNear(glm::dvec3(placed[3]), pose.translation));
    for (int axis = 0; axis < 3; ++axis)
      CHECK(isNear(glm::dvec3(placed[axis]), glm::mat3_cast(pose.rotation)[axis]));
  }
}

void checkStrands(const scenes::Strands& written, const host::Mesh& mesh) {
  REQUIRE(mesh.primitives.size() == 1);
  const host::Primitive& lines = mesh.primitives[0];
  CHECK(mesh.name == written.name);
  CHECK(lines.topology == host::Topology::Lines);
  CHECK(lines.strand.width == written.width);
  CHECK(lines.strand.opacity == written.opacity);
  CHECK(lines.indices == written.indices);
  REQUIRE(lines.vertices.size() == written.points.size());
  for (std::size_t i = 0; i < written.points.size(); i += 101)
    CHECK(lines.vertices[i].position == glm::vec3(written.points[i]));
}

void checkSmoke(const scenes::Smoke& written, const host::Scene& read, const host::SmokeEmitter& smoke) {
  CHECK(read.nodes[static_cast<std::size_t>(smoke.node)].name == written.name);
  CHECK(isNear(read.nodes[static_cast<std::size_t>(smoke.node)].translation, written.position));
  CHECK(smoke.particles == written.particles);
  CHECK(smoke.radius == written.radius);
  CHECK(smoke.growth == written.growth);
  CHECK(smoke.density == written.density);
  CHECK(smoke.spread == written.spread);
  CHECK(smoke.height == written.height);
  CHECK(smoke.rise == written.rise);
  CHECK(smoke.drift == written.drift);
  CHECK(smoke.turbulence == written.turbulence);
  CHECK(isNear(smoke.albedo, written.albedo));
  CHECK(smoke.seed == written.seed);
}

void checkReadBack(const scenes::Scene& written) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "scene.glb";
  scenes::writeGlb(written, file.string());
  const host::Scene read = host::loadScene(file);
  CHECK(read.notes.empty());
  checkLights(written, read);
  checkCamera(written.camera, read);
  checkAir(written, read);

  const std::vector<std::size_t> nodes = nodesWith(read, &host::Node::mesh);
  REQUIRE(nodes.size() == 1 + written.bodies.size() + written.strands.size());
  const auto meshOf = [&](std::size_t i) { return read.meshes[static_cast<std::size_t>(read.nodes[nodes[i]].mesh)]; };
  checkMesh(written, written.surfaces, read, meshOf(0));
  for (std::size_t i = 0; i < written.bodies.size(); ++i) {
    INFO(written.bodies[i].name);
    checkMesh(written, written.bodies[i].surfaces, read, meshOf(1 + i));
    checkPoses(written.bodies[i], read, nodes[1 + i]);
  }
  CHECK(read.animation.size() == 2 * written.bodies.size());
  for (std::size_t i = 0; i < written.strands.size(); ++i)
    checkStrands(written.strands[i], meshOf(1 + written.bodies.size() + i));
  REQUIRE(read.smoke.size() == written.smoke.size());
  for (std::size_t i = 0; i < written.smoke.size(); ++i)
    checkSmoke(written.smoke[i], read, read.smoke[i]);
}

} // namespace

TEST_CASE("Each sample scene is read back as its generator described it, light by light", "[scene][gltf]") {
  for (const auto& [name, make] : scenes::generators()) {
    INFO(name);
    checkReadBack(make());
  }
}

TEST_CASE("A turntable is read back as it was described", "[scene][gltf]") {
  const TemporaryFolder folder;
  const std::filesystem::path model = folder / "model.glb";
  writeBytes(model, everything().glb());
  checkReadBack(scenes::makeTurntable(model.string()));
}

} // namespace tests
