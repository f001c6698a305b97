// Every baseline converges to technique exact as its quality grows: each shows its own error, not another physics.
#include "baselines/Baseline.h"
#include "reference/Metrics.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <cmath>
#include <gl/ReadBack.h>
#include <glm/gtc/matrix_transform.hpp>

namespace {

constexpr int kShadowSize = 128;

/// Two pillars before a wall; a camera that looks at them from (0, 1, 6).
std::vector<float> sceneDepth(int width, int height) {
  std::vector<float> depth;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      depth.push_back(10 * x / width == 2 || 10 * x / width == 6 ? 0.1F / 5 : 0.1F / 12);
  return depth;
}

/// A room, lit from the upper left through a row of slits.
tests::ShadowRig slits(int layers = 1) {
  tests::ShadowRig shadow;
  shadow.image.width = shadow.image.height = kShadowSize;
  shadow.image.layers = layers;
  for (int layer = 0; layer < layers; ++layer)
    for (int y = 0; y < kShadowSize; ++y)
      for (int x = 0; x < kShadowSize; ++x)
        shadow.image.depth.push_back((x / 11 + y / 17) % 2 == 0 ? 1.0F : 0.3F);
  return shadow;
}

struct Rig {
  int width, height;
  tests::FrameRig frame;
  tests::ShadowRig shadow;

  explicit Rig(tyndall::LightKind kind, int scale = 1)
      : width(96 * scale), height(64 * scale), frame(width, height, sceneDepth(width, height)) {
    tyndall::Frame& f = frame.frame;
    f.camera.viewFromWorld = tests::lookAt({0, 1, 6}, {0.4, 1.2, 0});
    f.camera.clipFromView = tests::reversedInfinite(0.9, static_cast<double>(width) / height, 0.1);
    f.camera.clipDepth = tyndall::ClipDepth::ZeroToOne;
    f.medium.constituents = {{{0.02F, 0.03F, 0.04F}, tyndall::Phase::HenyeyGreenstein, 0.4F}};
    f.medium.farDistance = 40;
    tyndall::Light light;
    light.kind = kind;
    light.colour = {9, 8, 7};
    light.position = {-2, 5, 1};
    light.direction = {0.5, -1, -0.35};
    light.outerConeAngle = 0.6;
    light.innerConeAngle = 0.3;
    if (kind == tyndall::LightKind::Point)
      addCube(light);
    else
      addView(light);
    f.lights = {light};
  }

  static tyndall::Mat4 clipOf(const glm::dmat4& projection, const glm::dmat4& view) {
    return tests::toMat4(projection * view);
  }

  void addView(tyndall::Light& light) {
    shadow = slits();
    const glm::dvec3 position(-2, 5, 1), direction(0.5, -1, -0.35);
    const bool spot = light.kind == tyndall::LightKind::Spot;
    const glm::dmat4 view = glm::lookAt(spot ? position : -8.0 * direction, spot ? position + direction : glm::dvec3(0),
                                        glm::dvec3(0, 0, 1));
    light.shadow.views = {
        {clipOf(spot ? glm::perspective(1.3, 1.0, 0.2, 20.0) : glm::ortho(-7., 7., -7., 7., 0., 20.), view), 0}};
    shadow.upload(light);
  }

  void addCube(tyndall::Light& light) {
    shadow = slits(6);
    const glm::dvec3 position(-2, 5, 1);
    int layer = 0;
    for (const double sign : {1.0, -1.0})
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(0), up(0);
        direction[axis] = sign;
        up[(axis + 1) % 3] = 1;
        light.shadow.views.push_back({clipOf(glm::perspective(glm::half_pi<double>(), 1.0, 0.2, 20.0),
                                             glm::lookAt(position, position + direction, up)),
                                      layer++});
      }
    shadow.upload(light);
  }

  reference::ImageAnswer renderBaseline(bench::Baseline& baseline) {
    REQUIRE(baseline.reasonAgainst(frame.frame).empty());
    baseline.render(frame.frame);
    const auto read = [&](GLuint texture) {
      return reference::Image(width, height, host::readColour(texture, width, height, 3));
    };
    return {read(frame.frame.output.inscatter), read(frame.frame.output.transmittance)};
  }

  double errorOf(const std::unique_ptr<bench::Baseline>& baseline) {
    const reference::ImageAnswer exact = frame.render();
    const reference::ImageAnswer answer = renderBaseline(*baseline);
    CHECK(reference::compare(answer.transmittance, exact.transmittance).max < 1e-5);
    const reference::ErrorMetrics error = reference::compare(answer.inscatter, exact.inscatter);
    UNSCOPED_INFO(error.text());
    return error.rRmse;
  }
};

constexpr tyndall::LightKind kKinds[] = {tyndall::LightKind::Directional, tyndall::LightKind::Point,
                                         tyndall::LightKind::Spot};

} // namespace

TEST_CASE("fixed steps converge to exact") {
  for (const tyndall::LightKind kind : kKinds) {
    Rig rig(kind);
    INFO("light kind " << static_cast<int>(kind));
    const double coarse = rig.errorOf(bench::makeFixedSteps(16));
    const double fine = rig.errorOf(bench::makeFixedSteps(2048));
    CHECK(fine < 0.1 * coarse);
    CHECK(fine < 0.01);
  }
}

TEST_CASE("half resolution converges to exact but for what half the pixels cannot show") {
  for (const tyndall::LightKind kind : kKinds) {
    Rig rig(kind, 6);
    INFO("light kind " << static_cast<int>(kind));
    const double coarse = rig.errorOf(bench::makeHalfResolution(8));
    const double fine = rig.errorOf(bench::makeHalfResolution(512));
    CHECK(fine < coarse);
    CHECK(fine < 0.2);
  }
}

TEST_CASE("froxels converge to exact as they shrink") {
  for (const tyndall::LightKind kind : kKinds) {
    Rig rig(kind);
    INFO("light kind " << static_cast<int>(kind));
    const double coarse = rig.errorOf(bench::makeFroxels(24, 16, 16));
    const double fine = rig.errorOf(bench::makeFroxels(2 * rig.width, 2 * rig.height, 512));
    CHECK(fine < 0.5 * coarse);
    CHECK(fine < 0.2);
  }
}

TEST_CASE("epipolar sampling with a march per texel converges to exact") {
  Rig rig(tyndall::LightKind::Directional);
  const double coarse = rig.errorOf(bench::makeEpipolarMarch(24, 32));
  const double fine = rig.errorOf(bench::makeEpipolarMarch(640, 1024));
  CHECK(fine < 0.5 * coarse);
  CHECK(fine < 0.03);
}

TEST_CASE("a walk through the min/max pyramid is exact") {
  Rig rig(tyndall::LightKind::Directional);
  CHECK(rig.errorOf(bench::makePyramid()) < 1e-4);
}

TEST_CASE("rasterised light volumes converge to exact but for slanted walls") {
  Rig rig(tyndall::LightKind::Directional);
  const double coarse = rig.errorOf(bench::makeLightVolumes(16));
  const double fine = rig.errorOf(bench::makeLightVolumes(kShadowSize));
  CHECK(fine < 0.3 * coarse);
  CHECK(fine < 0.15);
}

TEST_CASE("incremental integration converges to exact") {
  Rig rig(tyndall::LightKind::Directional);
  const double coarse = rig.errorOf(bench::makeIncremental(24, 32));
  const double fine = rig.errorOf(bench::makeIncremental(640, 1024));
  CHECK(fine < 0.5 * coarse);
  CHECK(fine < 0.03);
}
