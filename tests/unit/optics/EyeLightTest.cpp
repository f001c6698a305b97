// A light at the eye (tyndall/avsm.h): its view is the camera's, its depth linear between two planes.
#include "OpticsCases.h"
#include "optics/Blocks.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <tyndall/avsm.h>

using namespace tests;
using glm::dvec3;
using tyndall::Camera;
using tyndall::ClipDepth;
using tyndall::Light;

namespace {

constexpr tyndall::Rectangle kImage{0, 0, 64, 40};
const dvec3 kEye(3, -2, 7), kDirection(0.4, -0.2, -1);

dvec3 ndcOf(const glm::dmat4& clipFromWorld, const dvec3& point) {
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
  REQUIRE(clip.w > 0);
  return dvec3(clip) / clip.w;
}

} // namespace

TEST_CASE("a light at the eye has the camera's image, and depth from 0 at one plane to 1 at the other") {
  Random random(3);
  for (const double scale : {1.0, 1e4})
    for (const Projection& p : projections(scale)) {
      Camera camera = cameraOf(p, scale * kEye, kDirection);
      const double near = 2 * scale, far = 37 * scale;
      Light light;
      REQUIRE(tyndall::eyeLight(camera, kImage, near, far, light));
      std::array<double, 4> depth{};
      REQUIRE(tyndall::avsmDepth(light, 0, depth));
      REQUIRE(light.shadow.views.size() == 1);
      CHECK(light.shadow.texture == 0);
      const glm::dmat4 image = host::fromMat4(camera.clipFromView) * host::fromMat4(camera.viewFromWorld),
                       seen = host::fromMat4(light.shadow.views[0].clipFromWorld);
      Camera moved = camera; // by a jitter, which the light is without
      moved.jitter = {0.3, -0.4};
      moved.clipFromView =
          host::toMat4(glm::translate(glm::dmat4(1), dvec3(0.6 / kImage.width, -0.8 / kImage.height, 0)) *
                       host::fromMat4(camera.clipFromView));
      Light still;
      REQUIRE(tyndall::eyeLight(moved, kImage, near, far, still));
      for (std::size_t i = 0; i < 16; ++i)
        CHECK(still.shadow.views[0].clipFromWorld[i] ==
              Approx(light.shadow.views[0].clipFromWorld[i]).margin(1e-9 * scale));
      const dvec3 forward = glm::normalize(kDirection), origin = tyndall::optics::cameraOrigin(camera);
      const double low = camera.clipDepth == ClipDepth::ZeroToOne ? 0 : -1;
      for (int i = 0; i < 200; ++i) {
        const double distance = random.within(near, far);
        const dvec3 aside(random.within(-0.3, 0.3), random.within(-0.3, 0.3), random.within(-0.3, 0.3));
        const dvec3 across = aside - glm::dot(aside, forward) * forward;
        const dvec3 point = origin + distance * (forward + across);
        CAPTURE(p.name, scale, distance);
        const double wanted = (distance - near) / (far - near);
        CHECK(depth[0] * point.x + depth[1] * point.y + depth[2] * point.z + depth[3] == Approx(wanted).margin(1e-9));
        const dvec3 own = ndcOf(seen, point), cameras = ndcOf(image, point);
        CHECK(own.x == Approx(cameras.x).margin(1e-9));
        CHECK(own.y == Approx(cameras.y).margin(1e-9));
        CHECK(own.z >= low - 1e-9);
        CHECK(own.z <= 1 + 1e-9);
      }
      CHECK(ndcOf(seen, origin + near * forward).z == Approx(low).margin(1e-9));
      CHECK(ndcOf(seen, origin + far * forward).z == Approx(1).margin(1e-9));
    }
}

TEST_CASE("a light at the eye is refused where the planes or the camera break a rule, by the field's name") {
  const double nan = std::nan(""), infinite = tyndall::kInfinity;
  const auto messageOf = [](const Camera& camera, double near, double far) {
    Light light;
    light.range = 17;
    const tyndall::Status status = tyndall::eyeLight(camera, kImage, near, far, light);
    CHECK(status.code == tyndall::StatusCode::InvalidFrame);
    CHECK(light.range == 17); // left as it was
    return status.message;
  };
  const auto contains = [](const std::string& text) { return Catch::Contains(text); };
  for (const Projection& p : projections()) {
    const Camera camera = cameraOf(p, kEye, kDirection);
    const bool orthographic = p.clipFromView[2][3] == 0;
    CAPTURE(p.name);
    for (const double near : {-1.0, nan, infinite})
      CHECK_THAT(messageOf(camera, near, 5), contains("eyeCurves.nearDistance is "));
    for (const double far : {1.0, 0.5, -3.0, 1.00001, nan, infinite})
      CHECK_THAT(messageOf(camera, 1, far), contains("eyeCurves.farDistance is "));
    Light light;
    if (orthographic) {
      CHECK(tyndall::eyeLight(camera, kImage, 0, 5, light));
      CHECK(tyndall::eyeLight(camera, kImage, 1e-9, 5, light));
    } else {
      CHECK_THAT(messageOf(camera, 0, 5), contains("eyeCurves.nearDistance is 0"));
      CHECK_THAT(messageOf(camera, 1e-6, 5), contains("at most 1e6 times"));
    }
    const tyndall::Status noImage = tyndall::eyeLight(camera, {}, 1, 5, light);
    CHECK_THAT(noImage.message, contains("viewport.width is 0"));
    Camera broken = camera;
    broken.clipFromView = {};
    CHECK_THAT(messageOf(broken, 1, 5), contains("camera.clipFromView"));
    broken = camera;
    broken.viewFromWorld[5] = nan;
    CHECK_THAT(messageOf(broken, 1, 5), contains("camera.viewFromWorld"));
  }
}
