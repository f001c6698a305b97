// The host's own shadow maps while a camera turns: what the shafts show of it. The picture's own camera stands still,
// so that nothing but texels that move in the world can change it.
#include "gl/SceneRenderer.h"
#include "gl/host/SmallScenes.h"
#include "reference/CameraRays.h"
#include "support/Catch.h"
#include "support/EffectRig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <scene/ShadowViews.h>

using namespace tyndall;

namespace {

constexpr int kTexels = 256, kFrames = 12;

// Slats and posts over a floor, around a place in the world.
host::Scene slats(const glm::dvec3& at) {
  host::Scene scene = tests::emptyScene();
  tests::addQuad(scene, at, {40, 0, 0}, {0, 0, 40});
  for (int i = -8; i <= 8; ++i) {
    tests::addQuad(scene, at + glm::dvec3(2.3 * i, 7, -12), {0.6F, 0, 0.1F}, {0, 0, 14});
    tests::addQuad(scene, at + glm::dvec3(1.7 * i, 3, -6 - std::abs(i)), {0.25F, 0, 0.1F}, {0, 3, 0});
  }
  return scene;
}

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& towards, double fovDegrees) {
  Camera camera;
  camera.viewFromWorld = tests::lookAt(eye, eye + towards);
  camera.clipFromView = tests::toMat4(glm::perspective(glm::radians(fovDegrees), 1.5, 0.1, 200.0));
  return camera;
}

double change(const reference::Image& now, const reference::Image& before) {
  double sum = 0, mean = 0;
  for (std::size_t i = 0; i < now.rgb.size(); ++i) {
    sum += (now.rgb[i] - before.rgb[i]) * (now.rgb[i] - before.rgb[i]);
    mean += now.rgb[i];
  }
  const auto count = static_cast<double>(now.rgb.size());
  return std::sqrt(sum / count) / (mean / count);
}

// The median change from frame to frame, a degree of turn and 0.1 of way apart, as a part of the mean.
double crawl(const glm::dvec3& at, int cascades, bool steady) {
  tests::testContext();
  const host::Scene scene = slats(at);
  const std::vector<glm::dmat4> pose = tests::restPose(scene);
  host::SceneRenderer renderer(scene);
  tests::FrameRig rig(48, 32, std::vector<float>(48 * 32, 1.0F)); // sky
  const glm::dvec3 eye = at + glm::dvec3(0, 2, 2);
  rig.frame.camera = cameraAt(eye, {0, 0.05, -1}, 30);
  rig.frame.medium = {{{{0.03F, 0.03F, 0.03F}, Phase::HenyeyGreenstein, 0.4F}}, {}, 30};
  Light sun;
  sun.direction = {0.25, -0.6, 0.5};
  rig.frame.lights = {sun};
  std::vector<double> changes;
  reference::Image before;
  for (int frame = 0; frame < kFrames; ++frame) {
    Light& light = rig.frame.lights[0];
    const double angle = glm::radians(double(frame));
    const Camera turned =
        cameraAt(eye + 0.1 * frame * glm::dvec3(0.2, 0, -1), {std::sin(angle), 0, -std::cos(angle)}, 80);
    host::fitShadowViews(light, scene, pose, turned,
                         {false, ClipDepth::NegativeOneToOne, cascades, steady ? kTexels : 0});
    const host::ShadowMapTextures maps = renderer.renderShadowMap(pose, light, kTexels);
    maps.attachTo(light);
    const reference::Image now = rig.render().inscatter;
    if (frame > 0) changes.push_back(change(now, before));
    before = now;
  }
  std::nth_element(changes.begin(), changes.begin() + kFrames / 2, changes.end());
  return changes[kFrames / 2];
}

} // namespace

TEST_CASE("shafts through steady shadow maps do not crawl while the camera turns, as those through tight ones do") {
  for (const glm::dvec3 at : {glm::dvec3(0), glm::dvec3(1e6, 0, -1e6)})
    for (const int cascades : {1, 3}) {
      const double tight = crawl(at, cascades, false), steady = crawl(at, cascades, true);
      CAPTURE(at.x, cascades, tight, steady);
      CHECK(tight > 1e-3);
      CHECK(steady < 0.1 * tight);
      CHECK((cascades > 1 || steady < 1e-5)); // one map stays as it is
    }
}
