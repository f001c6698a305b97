// Smoke and strands: what a file says of them, and where the particles are.
#include "GltfFile.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/ShadowViews.h>
#include <scene/Smoke.h>
#include <scene/Strands.h>

namespace {

host::Scene withSmoke(const host::SmokeEmitter& emitter, const glm::dvec3& place = {1, 2, 3}) {
  host::Scene scene;
  scene.materials.emplace_back();
  scene.nodes.emplace_back().translation = place;
  scene.smoke = {emitter};
  return scene;
}

bool isSame(const std::vector<host::SmokeParticle>& a, const std::vector<host::SmokeParticle>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.position == other.position && one.radius == other.radius && one.density == other.density &&
           one.albedo == other.albedo;
  });
}

tests::GltfFile smokeFile(const nlohmann::json& smoke) {
  tests::GltfFile file;
  file.json["nodes"] = {{{"translation", {1, 2, 3}}}, {{"extras", {{"tyndall", {{"smoke", smoke}}}}}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  return file;
}

tests::GltfFile lineFile() {
  tests::GltfFile file;
  const int positions = file.floats({0, 0, 0, 3, 0, 0, 3, 4, 0, 3, 4, 12}, "VEC3", 3);
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}}}}};
  file.show({{"attributes", {{"POSITION", positions}}}, {"mode", 3}, {"material", 0}});
  return file;
}

} // namespace

TEST_CASE("Smoke is a function of time alone", "[scene][smoke]") {
  host::SmokeEmitter emitter;
  emitter.seed = 7;
  const host::Scene scene = withSmoke(emitter);
  const std::vector<host::SmokeParticle> now = host::smokeAt(scene, 1.25);
  REQUIRE(now.size() == 200);
  host::smokeAt(scene, 99);
  CHECK(isSame(host::smokeAt(scene, 1.25), now));
  CHECK_FALSE(isSame(host::smokeAt(scene, 1.30), now));
  emitter.seed = 8;
  CHECK_FALSE(isSame(host::smokeAt(withSmoke(emitter), 1.25), now));
  // It repeats after a life.
  const std::vector<host::SmokeParticle> later = host::smokeAt(scene, 1.25 + emitter.lifetime());
  for (std::size_t i = 0; i < now.size(); ++i) {
    CHECK(glm::distance(later[i].position, now[i].position) < 1e-9);
    CHECK(later[i].density == Approx(now[i].density).margin(1e-9));
  }
}

TEST_CASE("Particles move without jumps, and are seen only between birth and death", "[scene][smoke]") {
  const host::Scene scene = withSmoke({});
  constexpr double kStep = 1e-3;
  for (double seconds = 0; seconds < scene.smoke[0].lifetime(); seconds += 0.37) {
    const std::vector<host::SmokeParticle> before = host::smokeAt(scene, seconds);
    const std::vector<host::SmokeParticle> after = host::smokeAt(scene, seconds + kStep);
    int born = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool isNew = after[i].position.y < before[i].position.y - 1;
      born += isNew ? 1 : 0;
      if (!isNew) CHECK(glm::distance(before[i].position, after[i].position) < 3 * kStep);
      CHECK(std::abs(after[i].density - before[i].density) < 0.03);
    }
    CHECK(born <= 2);
  }
}

TEST_CASE("All of the smoke is inside its bounds, whose size follows from the emitter", "[scene][smoke]") {
  for (const double growth : {0.5, 1.0, 4.0}) {
    host::SmokeEmitter emitter;
    emitter.growth = growth;
    emitter.drift = {0.4, 0.1, -0.7};
    emitter.turbulence = 0.9;
    const host::Scene scene = withSmoke(emitter);
    const host::Bounds bounds = host::smokeBounds(scene, emitter, 0);
    for (double seconds = 0; seconds < 8; seconds += 0.51) {
      CHECK(host::smokeBounds(scene, emitter, seconds).low == bounds.low);
      for (const host::SmokeParticle& particle : host::smokeAt(scene, seconds)) {
        CHECK(glm::all(glm::greaterThanEqual(particle.position - particle.radius, bounds.low)));
        CHECK(glm::all(glm::lessThanEqual(particle.position + particle.radius, bounds.high)));
        CHECK(particle.radius > 0);
        CHECK(particle.density >= 0);
        CHECK(particle.density * particle.radius <= emitter.density * emitter.radius * 1.0001);
      }
    }
  }
}

TEST_CASE("Smoke of a moving source stays where it was born", "[scene][smoke]") {
  host::SmokeEmitter emitter;
  emitter.turbulence = emitter.spread = 0;
  host::Scene scene = withSmoke(emitter, {0, 0, 0});
  host::AnimationChannel channel;
  channel.times = {0, 100};
  channel.values = {glm::vec4(0), glm::vec4(100, 0, 0, 0)};
  scene.animation = {channel};
  for (const host::SmokeParticle& particle : host::smokeAt(scene, 50)) {
    const double age = particle.position.y / emitter.height * emitter.lifetime();
    CHECK(particle.position.x == Approx(50 - age).margin(1e-6));
  }
  const host::Bounds bounds = host::smokeBounds(scene, emitter, 50);
  CHECK(bounds.low.x < 50 - emitter.lifetime());
  CHECK(bounds.high.x > 50);
}

TEST_CASE("A light's shadow views take in smoke and strands", "[scene][smoke][view]") {
  const host::Scene smoke = withSmoke({});
  const host::Scene strands = lineFile().load();
  for (const host::Scene* scene : {&smoke, &strands}) {
    const std::vector<glm::dmat4> pose = host::poseAt(*scene, 0);
    tyndall::Light light;
    light.kind = tyndall::LightKind::Spot;
    light.position = {1, 3, 20};
    light.direction = {0, 0, -1};
    host::fitShadowViews(light, *scene, pose, {});
    REQUIRE(light.shadow.views.size() == 1);
    const glm::dmat4 clipFromWorld = host::fromMat4(light.shadow.views[0].clipFromWorld);
    const glm::dvec3 middle = scene == &smoke ? glm::dvec3(1, 3, 3) : glm::dvec3(3, 4, 6);
    const glm::dvec4 clip = clipFromWorld * glm::dvec4(middle, 1);
    CHECK(std::abs(clip.z) < clip.w);
  }
}

TEST_CASE("Smoke comes from the extras of a node", "[scene][gltf][smoke]") {
  CHECK(tests::everything().load().smoke.empty());
  const host::Scene scene = smokeFile({{"particles", 12},
                                       {"radius", 0.5},
                                       {"growth", 2},
                                       {"density", 3},
                                       {"spread", 0},
                                       {"height", 5},
                                       {"rise", 2.5},
                                       {"drift", {1, 0, -1}},
                                       {"turbulence", 0.25},
                                       {"albedo", {0.5, 0.25, 1}},
                                       {"seed", 9}})
                                .load();
  REQUIRE(scene.smoke.size() == 1);
  const host::SmokeEmitter& smoke = scene.smoke[0];
  CHECK(smoke.node == 1);
  CHECK(smoke.particles == 12);
  CHECK(smoke.radius == 0.5);
  CHECK(smoke.growth == 2);
  CHECK(smoke.density == 3);
  CHECK(smoke.spread == 0);
  CHECK(smoke.lifetime() == 2);
  CHECK(smoke.drift == glm::dvec3(1, 0, -1));
  CHECK(smoke.turbulence == 0.25);
  CHECK(smoke.albedo == glm::vec3(0.5, 0.25, 1));
  CHECK(smoke.seed == 9);
  CHECK(smokeFile(nlohmann::json::object()).load().smoke.at(0).particles == host::SmokeEmitter().particles);
}

TEST_CASE("Smoke that breaks a rule is refused with node, field and rule", "[scene][gltf][smoke]") {
  const auto refusal = [](const char* key, const nlohmann::json& value) { return smokeFile({{key, value}}).refusal(); };
  const std::string where = "nodes[1].extras.tyndall.smoke.";
  CHECK_THAT(refusal("particles", 0), Catch::Contains(where + "particles: must be a whole number from 1 to 100000"));
  CHECK_THAT(refusal("particles", 100001), Catch::Contains(where + "particles"));
  CHECK_THAT(refusal("particles", 2.5), Catch::Contains(where + "particles"));
  for (const char* key : {"radius", "growth", "height", "rise"}) {
    CHECK_THAT(refusal(key, 0), Catch::Contains(where + key + ": must be greater than 0"));
    CHECK_THAT(refusal(key, "1"), Catch::Contains(where + key + ": must be a number"));
  }
  for (const char* key : {"density", "spread", "turbulence"})
    CHECK_THAT(refusal(key, -1), Catch::Contains(where + key + ": must be at least 0"));
  CHECK_THAT(refusal("radius", 1e300), Catch::Contains(where + "radius"));
  CHECK_THAT(refusal("drift", {1, 2}), Catch::Contains(where + "drift: must be 3 numbers"));
  CHECK_THAT(refusal("albedo", {1, 2, 0}), Catch::Contains(where + "albedo: must be 3 numbers from 0 to 1"));
  CHECK_THAT(refusal("seed", -1), Catch::Contains(where + "seed"));
  CHECK_THAT(refusal("colour", 1), Catch::Contains(where + "colour: is unknown, must be one of particles"));
  CHECK_THAT(smokeFile(3).refusal(), Catch::Contains("nodes[1].extras.tyndall.smoke: must be an object"));
}

TEST_CASE("Lines are strands, as their material and they themselves say", "[scene][gltf][strands]") {
  tests::GltfFile file = lineFile();
  const host::Scene plain = file.load();
  REQUIRE(host::hasStrands(plain));
  const host::Strand& strand = plain.meshes[0].primitives[0].strand;
  CHECK(strand.width == Approx(13.0 / 1500)); // of the bounds' diagonal
  CHECK(strand.opacity > 0);
  const host::Strands strands = host::strandsAt(plain, {glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 0))});
  REQUIRE(strands.points.size() == 4);
  REQUIRE(strands.segments.size() == 3);
  CHECK(strands.points[1].position == glm::dvec3(4, 0, 0));
  CHECK(glm::distance(strands.points[0].tangent, glm::dvec3(1, 0, 0)) < 1e-12);
  CHECK(glm::distance(strands.points[1].tangent, glm::normalize(glm::dvec3(1, 1, 0))) < 1e-12);
  CHECK(strands.points[2].albedo == glm::vec3(0.5, 0.25, 0.125));
  CHECK(host::boundsOf(plain, host::poseAt(plain, 0)).high == glm::dvec3(3, 4, 12));

  file.json["materials"][0]["extras"]["tyndall"]["strand"] = {{"width", 0.5}, {"opacity", 0.25}};
  CHECK(file.load().meshes[0].primitives[0].strand.width == 0.5);
  CHECK(file.load().meshes[0].primitives[0].strand.opacity == 0.25);
  nlohmann::json& extras = file.json["meshes"][0]["primitives"][0]["extras"]["tyndall"]["strand"];
  extras = {{"opacity", 1}};
  CHECK(file.load().meshes[0].primitives[0].strand.width == 0.5);
  CHECK(file.load().meshes[0].primitives[0].strand.opacity == 1);
  extras = {{"opacity", 1.5}};
  CHECK_THAT(file.refusal(),
             Catch::Contains("meshes[0].primitives[0].extras.tyndall.strand.opacity: must be at least 0 "
                             "and at most 1"));
  extras = {{"width", 0}};
  CHECK_THAT(file.refusal(), Catch::Contains("strand.width: must be greater than 0"));
}

TEST_CASE("of many strands some are drawn, each as wide as those that it stands for", "[scene][strands]") {
  host::Strands strands;
  constexpr unsigned kStrands = 20, kPoints = 5;
  for (unsigned strand = 0; strand < kStrands; ++strand)
    for (unsigned i = 0; i < kPoints; ++i) {
      strands.points.push_back({{strand, i, 0}, {0, 1, 0}, {0.5, 0.25}, glm::vec3(1)});
      if (i > 0) strands.segments.emplace_back(strand * kPoints + i - 1, strand * kPoints + i);
    }
  const host::Strands some = host::thinned(strands, 4);
  REQUIRE(some.segments.size() == strands.segments.size() / 4);
  for (const glm::uvec2& segment : some.segments) {
    CHECK(segment.y == segment.x + 1);
    CHECK(segment.x / kPoints % 4 == 0); // whole strands
    CHECK(some.points[segment.x].strand.width == 2);
    CHECK(some.points[segment.x].strand.opacity == 0.25);
  }
  CHECK(host::thinned({}, 4).segments.empty());
}
