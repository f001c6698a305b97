// Techniques tree and epipolar against exact, on maps where they must agree closely.
#include "gl/ReadBack.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kWidth = 160, kHeight = 96, kMap = 256;
constexpr int kFirstOfSky = 81; // row

// A wall with a step in front of the camera, some sky.
std::vector<float> sceneDepth() {
  std::vector<float> depth;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth.push_back(y >= kFirstOfSky ? 0.0F : x > 100 ? 0.05F / 4 : 0.05F / (6 + 0.01F * static_cast<float>(y)));
  return depth;
}

enum class Map { Lit, Dark, Slats };

// Casters above the scene; the slats are wide against a texel.
std::vector<float> casters(Map map, int layers) {
  std::vector<float> depth;
  for (int i = 0; i < layers * kMap * kMap; ++i) {
    const bool slat = map == Map::Dark || (map == Map::Slats && (i % kMap) / 32 % 2 == 0);
    depth.push_back(slat ? 0.05F : 1.0F);
  }
  return depth;
}

struct Rig {
  tests::FrameRig frame{kWidth, kHeight, sceneDepth()};
  tests::ShadowRig shadow;

  Rig(LightKind kind, Map map, const Vec3& direction) {
    Frame& f = frame.frame;
    f.camera.viewFromWorld = tests::lookAt({0, 1, 6}, {0.1, 0.4, 0});
    f.camera.clipFromView = tests::reversedInfinite(0.9, 1.6, 0.05);
    f.camera.clipDepth = ClipDepth::ZeroToOne;
    f.medium.constituents = {{{0.1F, 0.1F, 0.1F}, Phase::HenyeyGreenstein, 0.3F}};
    f.medium.farDistance = 30;
    Light light;
    light.kind = kind;
    light.direction = direction;
    light.position = {-0.7, 3.5, 0.4};
    light.colour = {5, 4, 3};
    light.outerConeAngle = 0.7;
    const glm::dvec3 d = glm::normalize(glm::dvec3(direction[0], direction[1], direction[2]));
    const glm::dvec3 p(-0.7, 3.5, 0.4), up = std::abs(d.z) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dmat4 clip =
        kind == LightKind::Directional
            ? glm::ortho(-9.0, 9.0, -9.0, 9.0, 1.0, 40.0) * glm::lookAt(-20.0 * d, glm::dvec3(0), up)
            : glm::perspective(1.42, 1.0, 0.3, 30.0) * glm::lookAt(p, p + d, up);
    light.shadow.views = {{tests::toMat4(clip), 0}};
    f.lights = {light};
    shadow.image = {kMap, kMap, 1, casters(map, 1), {}, {}};
    shadow.upload(f.lights[0]);
  }

  reference::ErrorMetrics errorOf(Technique technique) {
    frame.frame.settings.technique = Technique::Exact;
    const reference::Image truth = frame.render().inscatter;
    frame.frame.settings.technique = technique;
    frame.frame.settings.slices = 2048;
    return reference::compare(frame.render().inscatter, truth);
  }
};

const std::vector<Vec3> kDirections = {{0.4, -1, -0.3}, {0.1, -0.3, -1}, {-0.2, -0.3, 1}, {0, -1, 0}, {1, -0.2, 0}};

} // namespace

TEST_CASE("tree and epipolar equal exact where every texel is lit", "[sweep]") {
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot})
    for (const Vec3& direction : kDirections)
      for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
        if (kind == LightKind::Spot && technique == Technique::Epipolar)
          continue; // the cone's wall is interpolated over
        CAPTURE(static_cast<int>(kind), direction[0], direction[1], direction[2], static_cast<int>(technique));
        const reference::ErrorMetrics lit = Rig(kind, Map::Lit, direction).errorOf(technique);
        INFO(lit.text());
        CHECK(lit.mean > 0);
        CHECK(lit.rRmse <= (technique == Technique::Tree ? 1e-4 : 5e-3));
        CHECK(lit.p99 <= (technique == Technique::Tree ? 1e-4 : 1.2e-2));
      }
}

// The sky is lit: what lies above the casters is, in front of them. The near plane is 1, they hang at 5 % of the depth
// range.
TEST_CASE("tree and epipolar give black where every texel is dark") {
  for (const Vec3& direction : kDirections)
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      CAPTURE(direction[0], direction[1], direction[2], static_cast<int>(technique));
      Rig rig(LightKind::Directional, Map::Dark, direction);
      rig.frame.frame.settings.technique = Technique::Exact;
      const reference::Image truth = rig.frame.render().inscatter;
      rig.frame.frame.settings.technique = technique;
      const reference::Image inscatter = rig.frame.render().inscatter;
      const auto wall = inscatter.rgb.begin() + 3 * kWidth * (kFirstOfSky - (technique == Technique::Tree ? 0 : 1));
      CHECK(std::all_of(inscatter.rgb.begin(), wall, [](double value) { return value == 0; }));
      const reference::ErrorMetrics error = reference::compare(inscatter, truth);
      CHECK(error.mean > 2e-3);
      CHECK(error.rRmse <= (technique == Technique::Tree ? 1e-4 : 0.02));
    }
}

TEST_CASE("tree and epipolar come close to exact behind wide slats") {
  for (const Vec3& direction : {kDirections[0], kDirections[1], kDirections[2], kDirections[4]})
    for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
      CAPTURE(direction[0], direction[1], direction[2], static_cast<int>(technique));
      const reference::ErrorMetrics error = Rig(LightKind::Directional, Map::Slats, direction).errorOf(technique);
      INFO(error.text());
      CHECK(error.mean > 0);
      CHECK(error.rRmse <= 0.03);
    }
}

TEST_CASE("the first frame of an effect equals its second") {
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    host::Context& context = tests::testContext();
    const std::unique_ptr<Effect> created = tests::newEffect({context.loader()});
    Rig rig(LightKind::Directional, Map::Slats, kDirections[0]);
    rig.frame.frame.settings.technique = technique;
    const auto pixels = [&] {
      REQUIRE(created->render(rig.frame.frame));
      return host::readColour(rig.frame.frame.output.inscatter, kWidth, kHeight, 3);
    };
    const std::vector<float> first = pixels();
    CHECK(pixels() == first);
  }
}

TEST_CASE("transmittance is the same by every technique, with several views and lights", "[sweep]") {
  Rig rig(LightKind::Directional, Map::Slats, kDirections[0]);
  Frame& frame = rig.frame.frame;
  frame.lights[0].shadow.views.push_back(frame.lights[0].shadow.views[0]);
  frame.lights.push_back(frame.lights[0]);
  const reference::Image expected = rig.frame.render().transmittance;
  for (const Technique technique : {Technique::Tree, Technique::Epipolar}) {
    frame.settings.technique = technique;
    CHECK(reference::compare(rig.frame.render().transmittance, expected).max <= 1e-6);
  }
}
