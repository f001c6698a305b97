// Strands in the picture, in a light's curves, and in none of its shadow maps.
#include "gl/ReadBack.h"
#include "gl/SceneRenderer.h"
#include "gl/avsm/AvsmRig.h"
#include "gl/host/SmallScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>

using tests::AvsmRig;
using tests::restPose;

namespace {

constexpr int kSide = 32;
constexpr double kDepth = 5; ///< distance of the strand from the origin, along -z

/// One strand from x = -3 to 3, tilted by `slope`.
host::Scene strandScene(double width, double opacity, float slope = 0) {
  host::Scene scene = tests::emptyScene();
  host::Primitive lines;
  lines.topology = host::Topology::Lines;
  constexpr std::uint32_t kPoints = 25;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const float x = -3 + 0.25F * static_cast<float>(i);
    lines.vertices.push_back({{x, slope * x + 0.03F, -static_cast<float>(kDepth)}, {0, 0, 0}, {0, 0}});
    if (i > 0) lines.indices.insert(lines.indices.end(), {i - 1, i});
  }
  lines.strand = {width, opacity};
  scene.meshes.push_back({"strand", {lines}});
  scene.nodes.emplace_back().mesh = 0;
  return scene;
}

host::Strands strandsOf(const host::Scene& scene) { return host::strandsAt(scene, restPose(scene)); }

} // namespace

TEST_CASE("a strand covers its width of the picture and leaves its depth", "[strands]") {
  tests::testContext();
  const glm::dmat4 clipFromView = host::orthographic(2, 2, 0.1, 10, {});
  for (const double pixels : {0.25, 1.0, 3.5})
    for (const float slope : {0.0F, 0.3F}) {
      INFO(pixels << " pixels wide, slope " << slope);
      const host::Scene scene = strandScene(pixels * 4 / kSide, 0.8, slope);
      host::SceneRenderer renderer(scene);
      renderer.setVolumes({}, strandsOf(scene));
      host::RenderTargets targets({kSide, kSide, GL_RGBA32F});
      // Ambient light alone: a quarter of the sky, over the sky itself.
      renderer.renderScene(restPose(scene), tests::cameraAtOrigin(clipFromView), {}, targets, glm::vec3(4));
      const std::vector<float> red = host::readColour(targets.colour(), kSide, kSide, 1);
      const std::vector<float> depth = host::readDepth(targets.depth(), kSide, kSide);
      double covered = 0;
      for (const float value : red)
        covered += (4 - value) / 3;
      CHECK(covered / kSide == Approx(0.8 * pixels * std::hypot(1, slope)).epsilon(0.06));
      const float nearest = *std::min_element(depth.begin(), depth.end());
      CHECK(nearest == Approx(tests::depthAt(clipFromView, {}, kDepth)).margin(1e-6));
    }
}

TEST_CASE("a captured strand stops its share of the light at once", "[strands]") {
  if (!tests::hasAvsm()) return;
  for (const bool spot : {false, true})
    for (const double texels : {0.4, 2.0})
      for (const float slope : {0.0F, 0.3F}) {
        INFO((spot ? "spot, " : "directional, ") << texels << " texels wide, slope " << slope);
        const double half = spot ? kDepth : 2; // of the map, where the strand is
        const host::Scene scene = strandScene(texels * 2 * half / kSide, 0.5, slope);
        const tyndall::Light light = spot ? tests::spotAtOrigin(1, 10) : tests::sunAlongZ(2, 0, -10);
        host::SceneRenderer renderer(scene);
        renderer.setVolumes({}, strandsOf(scene));
        tyndall::AvsmConfig config;
        config.size = kSide;
        AvsmRig rig(config);
        REQUIRE(rig.avsm().begin());
        renderer.captureVolumes(light, kSide);
        REQUIRE(rig.avsm().resolve());
        const double depth = spot ? (kDepth - 1) / 9 : kDepth / 10;
        double before = 0, stopped = 0;
        const int first = spot ? kSide / 4 : 0,
                  last = spot ? 3 * kSide / 4 : kSide; // the strand ends within a spot's map
        for (int x = first; x < last; ++x)
          for (int y = 0; y < kSide; ++y) {
            const tests::Curve curve = rig.curve({x, y, 0});
            before = std::max(before, 1 - tests::curveAt(curve, depth - 0.01));
            stopped += 1 - tests::curveAt(curve, depth + 0.01);
          }
        CHECK(before == 0);
        CHECK(stopped / (last - first) == Approx(0.5 * texels * std::hypot(1, slope)).epsilon(0.08));
      }
}

TEST_CASE("strands are in no shadow map", "[strands]") {
  tests::testContext();
  const host::Scene scene = strandScene(1, 1);
  host::SceneRenderer renderer(scene);
  renderer.setVolumes({}, strandsOf(scene));
  const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), tests::sunAlongZ(2, 0, -10), kSide);
  for (const float depth : host::readDepthArray(maps.depth.name(), kSide, kSide, 0))
    CHECK(depth == 1.0F);
}

TEST_CASE("strands behind smoke are dimmed by it", "[strands]") {
  if (!tests::hasAvsm()) return;
  const host::Scene scene = strandScene(0.5, 1);
  host::SmokeParticle smoke;
  smoke.position = {0, 0, -2};
  smoke.radius = 1.5;
  smoke.density = 0.6;
  tyndall::Light light = tests::sunAlongZ(4, 0, -10);
  const auto radiance = [&](double density) {
    host::SceneRenderer renderer(scene);
    const host::ShadowMapTextures maps = renderer.renderShadowMap(restPose(scene), light, 64);
    maps.attachTo(light);
    tyndall::AvsmConfig config;
    config.size = 64;
    AvsmRig rig(config);
    REQUIRE(rig.avsm().begin());
    smoke.density = density;
    renderer.setVolumes({smoke}, {});
    renderer.captureVolumes(light, 64);
    REQUIRE(rig.avsm().resolve());
    light.curves = rig.avsm().curves();
    renderer.setVolumes({}, strandsOf(scene));
    host::RenderTargets targets({kSide, kSide, GL_RGBA32F});
    renderer.renderScene(restPose(scene), tests::cameraAtOrigin(host::orthographic(2, 2, 0.1, 10, {})), {light},
                         targets, glm::vec3(0));
    return host::readColour(targets.colour(), kSide, kSide, 1)[kSide / 2 * kSide + kSide / 2];
  };
  const float lit = radiance(1e-3), dimmed = radiance(0.6);
  CHECK(lit > 0.01F);
  CHECK(dimmed == Approx(lit * std::exp(-0.6 * 1.5 * 16 / 15)).epsilon(0.06));
}
