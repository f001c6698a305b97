// Avsm::drawParticles(): spheres into curves, in order and in fixed memory, against closed forms and captured lists.
#include "AvsmRig.h"
#include "gl/effect/GlState.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

using namespace tyndall;
using host::gl;
using tests::AvsmRig;
using tests::Captured;
using tests::checkNear;
using tests::Curve;
using tests::kSpotFar;
using tests::kSpotNear;
using tests::parallelLight;
using tests::spotLight;

namespace {

struct Sphere {
  glm::vec3 centre{0};
  float radius = 0, density = 0;
};

AvsmConfig configOf(int size, int nodes = 8, bool packed = false) {
  AvsmConfig config;
  config.size = size;
  config.nodes = nodes;
  config.packed = packed;
  config.reduction = CurveReduction::InOrder;
  return config;
}

struct ParticleBuffer {
  host::GlBuffer buffer = host::makeBuffer();
  AvsmParticles particles;

  // `lead` floats before, `rest` behind each.
  explicit ParticleBuffer(const std::vector<Sphere>& spheres, int lead = 0, int rest = 0) {
    std::vector<float> data(static_cast<std::size_t>(lead), 1e9F);
    for (const Sphere& s : spheres) {
      data.insert(data.end(), {s.centre.x, s.centre.y, s.centre.z, s.radius, s.density});
      data.insert(data.end(), static_cast<std::size_t>(rest), 1e9F);
    }
    gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    gl().BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(data.size() * sizeof(float)), data.data(),
                    GL_STATIC_DRAW);
    gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
    particles = {buffer.name(),
                 4 * static_cast<std::uint64_t>(lead),
                 static_cast<std::uint32_t>(20 + 4 * rest),
                 static_cast<std::uint32_t>(spheres.size()),
                 {0, 0, 0}};
  }
};

void draw(AvsmRig& rig, const Light& light, const std::vector<Sphere>& spheres) {
  const ParticleBuffer buffer(spheres);
  REQUIRE(rig.avsm().beginStreaming());
  const Status drawn = rig.avsm().drawParticles(light, buffer.particles);
  INFO(drawn.message);
  REQUIRE(drawn);
  REQUIRE(rig.avsm().resolve());
}

// What passes all of the spheres along a texel's ray, of which the light starts at a depth; by the ray's own two
// points.
double passedBy(const std::vector<Sphere>& spheres, const glm::dvec3& start, const glm::dvec3& end, double lightDepth) {
  double opticalDepth = 0;
  const glm::dvec3 along = end - start;
  for (const Sphere& s : spheres) {
    const glm::dvec3 from = start - glm::dvec3(s.centre);
    const double a = glm::dot(along, along), b = glm::dot(along, from);
    const double root = b * b - a * (glm::dot(from, from) - double{s.radius} * s.radius);
    if (root <= 0) continue;
    const double entry = std::max((-b - std::sqrt(root)) / a, lightDepth), exit = (-b + std::sqrt(root)) / a;
    if (exit > entry && entry < 1) opticalDepth += s.density * (std::min(exit, 1.0) - entry) * std::sqrt(a);
  }
  return std::exp(-opticalDepth);
}

// Spheres on the axis whose ends in depth are exact in floats, in a random order.
std::vector<Sphere> spheresOnAxis(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    const float z = static_cast<float>(static_cast<int>(random() % 1800) - 900) / 1024;
    const float radius = static_cast<float>(1 + random() % 100) / 1024;
    spheres.push_back({{0, 0, z}, radius, 0.01F + static_cast<float>(random() % 1000) * 0.0004F});
  }
  return spheres;
}

std::vector<Captured> segmentsOnAxis(const std::vector<Sphere>& spheres) {
  std::vector<Captured> segments;
  for (const Sphere& s : spheres)
    segments.push_back({{0, 0, 0},
                        (1 - s.centre.z - s.radius) / 2,
                        (1 - s.centre.z + s.radius) / 2,
                        std::exp(-s.density * 2 * s.radius)});
  return segments;
}

} // namespace

TEST_CASE("avsm particles: one sphere's curve is that of its chord") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 9;
  for (const bool packed : {false, true}) {
    AvsmRig rig(configOf(kSize, 8, packed));
    draw(rig, parallelLight(), {{{0, 0, 0}, 0.5F, 2}});
    for (int x = 0; x < kSize; ++x) {
      const Curve curve = rig.curve({x, 4, 0});
      const double at = (x + 0.5) / kSize * 2 - 1, rest = 0.25 - at * at;
      CAPTURE(x, packed);
      if (rest <= 0) {
        for (const glm::dvec2& node : curve)
          CHECK(node == glm::dvec2(1));
        continue;
      }
      const double half = std::sqrt(rest);
      CHECK(curve[0].x == Approx((1 - half) / 2).margin(2e-5));
      CHECK(curve[0].y == 1);
      CHECK(curve[1].x == Approx((1 + half) / 2).margin(2e-5));
      CHECK(curve[1].y == Approx(std::exp(-2 * 2 * half)).margin(2e-5));
    }
  }
}

TEST_CASE("avsm particles: what comes through is the product over all spheres, in every tile, view and projection") {
  if (!tests::hasAvsm()) return;
  constexpr int kSize = 37;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 400; ++i)
    spheres.push_back({{uniform(random), uniform(random), 1.5F * uniform(random)},
                       0.1F + 0.09F * uniform(random),
                       1 + 0.9F * uniform(random)});
  spheres.push_back({{0.1F, 0.2F, 1.9F}, 0.3F, 0.5F}); // around the spot light
  spheres.push_back({{0, 0, 2.5F}, 0.3F, 5});          // behind it, and in front of the near plane of the parallel one
  for (const bool reversed : {false, true})
    for (const bool spot : {true, false}) {
      AvsmRig rig(configOf(kSize));
      draw(rig, spot ? spotLight(reversed) : parallelLight(), spheres);
      const std::vector<glm::vec2> places;
      double worst = 0;
      std::vector<glm::ivec3> texels;
      for (int i = 0; i < kSize * kSize; ++i)
        texels.emplace_back(i % kSize, i / kSize, 0);
      const std::vector<float> found = rig.lookUp(texels, std::vector<float>(texels.size(), 1.0F));
      for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec2 at = (glm::dvec2(texels[i]) + 0.5) / double{kSize} * 2.0 - 1.0;
        const glm::dvec3 side = glm::dvec3(at * std::tan(0.5), -1);
        const double expected = spot ? passedBy(spheres, glm::dvec3(0, 0, 2) + kSpotNear * side,
                                                glm::dvec3(0, 0, 2) + kSpotFar * side, tests::depthOfSpot())
                                     : passedBy(spheres, {at, 1}, {at, -1}, -1e9);
        worst = std::max(worst, std::abs(found[i] - expected));
      }
      CAPTURE(reversed, spot);
      CHECK(worst < 1e-4); // where a ray just touches a sphere, its chord is the root of what floats round
    }
}

TEST_CASE("avsm particles: curves equal those of captured lists in the same order") {
  if (!tests::hasAvsm()) return;
  for (const int nodes : {4, 8, 12, 16})
    for (const bool packed : {false, true}) {
      const std::vector<Sphere> spheres = spheresOnAxis(1000, 11);
      AvsmRig drawn(configOf(1, nodes, packed)), listed(configOf(1, nodes, packed));
      draw(drawn, parallelLight(), spheres);
      tests::captureLastFirst(listed.avsm(), segmentsOnAxis(spheres));
      REQUIRE(listed.avsm().resolve()); // the memory grows
      gl().Finish();
      tests::captureLastFirst(listed.avsm(), segmentsOnAxis(spheres));
      REQUIRE(listed.avsm().resolve());
      CHECK(listed.avsm().statistics().lost == 0);
      CAPTURE(nodes, packed);
      checkNear(drawn.curve({0, 0, 0}), listed.curve({0, 0, 0}), packed ? 2e-5 : 2e-6);
    }
}

TEST_CASE("avsm particles: in the order of depth curves equal those of sorted lists") {
  if (!tests::hasAvsm()) return;
  std::vector<Sphere> spheres = spheresOnAxis(200, 12);
  std::sort(spheres.begin(), spheres.end(),
            [](const Sphere& a, const Sphere& b) { return a.centre.z + a.radius > b.centre.z + b.radius; });
  // Of the same entry only one, so that there is one order.
  spheres.erase(
      std::unique(spheres.begin(), spheres.end(),
                  [](const Sphere& a, const Sphere& b) { return a.centre.z + a.radius == b.centre.z + b.radius; }),
      spheres.end());
  AvsmConfig config = configOf(1);
  config.reduction = CurveReduction::Sorted;
  AvsmRig drawn(config), sorted(config);
  draw(drawn, parallelLight(), spheres);
  std::vector<Captured> segments = segmentsOnAxis(spheres);
  std::shuffle(segments.begin(), segments.end(), std::mt19937(1));
  sorted.capture(segments);
  sorted.capture(segments);
  CHECK(sorted.avsm().statistics().lost == 0);
  checkNear(drawn.curve({0, 0, 0}), sorted.curve({0, 0, 0}), 2e-6);
}

TEST_CASE("avsm particles: any number of them, in one call or several") {
  if (!tests::hasAvsm()) return;
  std::vector<Sphere> spheres = spheresOnAxis(70000, 13);
  double opticalDepth = 0;
  for (Sphere& s : spheres) {
    s.density *= 1e-3F;
    opticalDepth += 2.0 * s.radius * s.density;
  }
  AvsmRig once(configOf(1)), twice(configOf(1));
  draw(once, parallelLight(), spheres);
  // A float near 1 is rounded by up to 2^-25, twice for each.
  CHECK(once.curve({0, 0, 0}).back().y == Approx(std::exp(-opticalDepth)).epsilon(70000 / std::pow(2, 24)));
  const ParticleBuffer first({spheres.begin(), spheres.begin() + 40001}, 3, 2);
  const ParticleBuffer second({spheres.begin() + 40001, spheres.end()}, 1, 0);
  REQUIRE(twice.avsm().beginStreaming());
  CHECK(twice.avsm().drawParticles(parallelLight(), first.particles));
  CHECK(twice.avsm().drawParticles(parallelLight(), second.particles));
  REQUIRE(twice.avsm().resolve());
  CHECK(once.bits() == twice.bits());
  CHECK(once.avsm().statistics().listBytes == 0);
}

TEST_CASE("avsm particles: an origin far away, and each view in its layer") {
  if (!tests::hasAvsm()) return;
  const std::vector<Sphere> spheres = {{{0.25F, -0.5F, 0.125F}, 0.5F, 2}, {{-0.5F, 0.25F, -0.25F}, 0.25F, 1}};
  AvsmRig near(configOf(8));
  draw(near, parallelLight(), spheres);
  AvsmConfig config = configOf(8);
  config.layers = 2;
  AvsmRig far(config);
  ParticleBuffer buffer(spheres);
  buffer.particles.origin = {1e7, -2e7, 3e7};
  Light light = parallelLight();
  const glm::dmat4 moved =
      glm::scale(glm::dmat4(1), glm::dvec3(1, 1, -1)) * glm::translate(glm::dmat4(1), glm::dvec3(-1e7, 2e7, -3e7));
  light.shadow.views = {{tests::toMat4(glm::scale(glm::dmat4(1), glm::dvec3(1e3, 1, 1)) * moved), 0},
                        {tests::toMat4(moved), 1}};
  REQUIRE(far.avsm().beginStreaming());
  CHECK(far.avsm().drawParticles(light, buffer.particles));
  REQUIRE(far.avsm().resolve());
  for (int i = 0; i < 64; ++i)
    checkNear(far.curve({i % 8, i / 8, 1}), near.curve({i % 8, i / 8, 0}), 1e-6);
  CHECK(far.curve({4, 2, 0}) != near.curve({4, 2, 0}));
}

TEST_CASE("avsm particles: those without a radius, a density or a number are left out, and opaque ones are opaque") {
  if (!tests::hasAvsm()) return;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  AvsmRig rig(configOf(1));
  draw(rig, parallelLight(),
       {{{0, 0, 0}, 0, 1},
        {{0, 0, 0}, -0.5F, 1},
        {{0, 0, 0}, kNaN, 1},
        {{0, 0, 0}, kInf, 1},
        {{0, 0, 0}, 0.5F, 0},
        {{0, 0, 0}, 0.5F, -1},
        {{0, 0, 0}, 0.5F, kNaN},
        {{kNaN, 0, 0}, 0.5F, 1},
        {{0, 0, kNaN}, 0.5F, 1},
        {{0, kInf, 0}, 0.5F, 1},
        {{0, 0, -3}, 0.5F, 1}});
  for (const glm::dvec2& node : rig.curve({0, 0, 0}))
    CHECK(node == glm::dvec2(1));
  draw(rig, parallelLight(), {{{0, 0, 0}, 0.5F, kInf}});
  CHECK(rig.curve({0, 0, 0}).back() == glm::dvec2(0.75, 0));
  draw(rig, parallelLight(), {});
  CHECK(rig.curve({0, 0, 0}).front() == glm::dvec2(1));
}

TEST_CASE("avsm particles: what breaks a rule is named, and draws nothing") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(4));
  const ParticleBuffer buffer({{{0, 0, 0}, 0.5F, 2}, {{0, 0, 0}, 0.5F, 2}});
  const auto check = [&](const std::string& word, const AvsmParticles& particles, const Light& light) {
    const Status status = rig.avsm().drawParticles(light, particles);
    INFO(status.message);
    CHECK(status.code == StatusCode::InvalidFrame);
    CHECK(status.message.find(word) != std::string::npos);
    CHECK(status.message.find('\n') == std::string::npos);
  };
  check("drawParticles needs a beginStreaming()", buffer.particles, parallelLight());
  REQUIRE(rig.avsm().begin());
  check("drawParticles needs a beginStreaming()", buffer.particles, parallelLight());
  REQUIRE(rig.avsm().beginStreaming());
  const auto checkParticles = [&](const std::string& word, const auto& change) {
    AvsmParticles particles = buffer.particles;
    change(particles);
    check("particles." + word, particles, parallelLight());
  };
  checkParticles("buffer is 0", [](AvsmParticles& p) { p.buffer = 0; });
  checkParticles("buffer is 4000", [](AvsmParticles& p) { p.buffer = 4000; });
  for (const std::uint32_t stride : {0U, 16U, 22U, 260U})
    checkParticles("stride is " + std::to_string(stride), [&](AvsmParticles& p) { p.stride = stride; });
  checkParticles("offset is 2", [](AvsmParticles& p) { p.offset = 2; });
  checkParticles("count is 2", [](AvsmParticles& p) { p.offset = 4; });
  checkParticles("count is 3", [](AvsmParticles& p) { p.count = 3; });
  checkParticles("count is 4294967295", [](AvsmParticles& p) { p.count = UINT32_MAX; });
  checkParticles("origin is", [](AvsmParticles& p) { p.origin[1] = kInfinity; });
  gl().BindBuffer(GL_ARRAY_BUFFER, buffer.buffer.name());
  gl().MapBufferRange(GL_ARRAY_BUFFER, 0, 4, GL_MAP_READ_BIT);
  checkParticles("buffer is", [](AvsmParticles&) {});
  gl().UnmapBuffer(GL_ARRAY_BUFFER);
  Light light = parallelLight();
  light.shadow.views.clear();
  check("views.size() is 0", buffer.particles, light);
  light = parallelLight();
  light.shadow.views.push_back(light.shadow.views[0]);
  check("must be 1 to 1", buffer.particles, light);
  light = parallelLight();
  light.shadow.views[0].clipFromWorld[0] = 0;
  check("view is 0: its matrix must be invertible", buffer.particles, light);
  light = parallelLight();
  light.direction[2] = std::nan("");
  check("view is 0: the light's direction or position must be finite", buffer.particles, light);
  light.direction = {0, 0, 0};
  check("view is 0: the light's direction must have a length", buffer.particles, light);
  light = spotLight(false);
  light.shadow.views[0].clipFromWorld =
      tests::toMat4(glm::infinitePerspective(1.0, 1.0, 0.5) * glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2)));
  check("view is 0: its far plane must not be at infinity", buffer.particles, light);
  REQUIRE(rig.avsm().resolve());
  for (int i = 0; i < 16; ++i)
    CHECK(rig.curve({i % 4, i / 4, 0}).back().y == 1);
}

TEST_CASE("avsm particles: a poisoned GL state is on return what it was on entry, and changes nothing") {
  if (!tests::hasAvsm()) return;
  AvsmRig rig(configOf(9)), poisoned(configOf(9));
  const std::vector<Sphere> spheres = {{{0, 0, 0}, 0.5F, 2}};
  draw(rig, parallelLight(), spheres);
  const ParticleBuffer buffer(spheres);
  Status begun, drawn, resolved;
  tests::GlState before, after;
  {
    const tests::Poison poison;
    before = tests::captureGlState();
    begun = poisoned.avsm().beginStreaming();
    drawn = poisoned.avsm().drawParticles(parallelLight(), buffer.particles);
    resolved = poisoned.avsm().resolve();
    after = tests::captureGlState();
    tests::Poison::lift();
  }
  CHECK(begun);
  CHECK(drawn);
  CHECK(resolved);
  for (const auto& [name, values] : before) {
    CAPTURE(name);
    CHECK(after.at(name) == values);
  }
  CHECK(poisoned.bits() == rig.bits());
}
