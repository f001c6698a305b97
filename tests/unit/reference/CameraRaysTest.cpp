#include "TestScenes.h"
#include "support/Catch.h"

#include <cmath>
#include <reference/CameraRays.h>
#include <string>

using namespace reference;
using namespace tests;
using tyndall::ClipDepth;

TEST_CASE("camera rays: known points, all conventions", "[reference][camera]") {
  for (const Convention& convention : kConventions) {
    CAPTURE(static_cast<int>(convention.clipDepth), convention.reversed);
    MapScene scene = emptyScene(convention);
    SECTION("perspective" + std::to_string(&convention - kConventions)) {
      const CameraRays rays(scene.camera, kWidth, kHeight);
      CHECK(rays.reversed() == convention.reversed);
      const Ray ray = rays.ray(5, 3);
      CHECK(glm::length(ray.origin - glm::dvec3(0.3, 1.5, 12)) < 1e-12);
      const glm::dvec4 clip =
          toMat4(scene.camera.clipFromView) * toMat4(scene.camera.viewFromWorld) * glm::dvec4(ray.at(7), 1);
      CHECK(clip.x / clip.w == Approx(2 * 5.5 / kWidth - 1).epsilon(1e-12));
      CHECK(clip.y / clip.w == Approx(2 * 3.5 / kHeight - 1).epsilon(1e-12));
      const double ndc = clip.z / clip.w;
      const double depth = convention.clipDepth == ClipDepth::ZeroToOne ? ndc : 0.5 * ndc + 0.5;
      CHECK(rays.distance(5, 3, depth) == Approx(7).epsilon(1e-10));
      CHECK(std::isinf(rays.distance(5, 3, convention.reversed ? 0 : 1)));
      CHECK(std::isnan(rays.distance(5, 3, std::nan(""))));
    }
    SECTION("infinite far plane" + std::to_string(&convention - kConventions)) {
      scene.camera.clipFromView = toTyndall(convention.convert() * glm::infinitePerspective(0.8, 1.5, 0.1));
      const CameraRays rays(scene.camera, kWidth, kHeight);
      CHECK(rays.reversed() == convention.reversed);
      CHECK(glm::length(rays.ray(0, 0).origin - glm::dvec3(0.3, 1.5, 12)) < 1e-12);
      CHECK(std::isinf(rays.nearToFar(2, 2).end));
    }
    SECTION("orthographic" + std::to_string(&convention - kConventions)) {
      scene.camera.viewFromWorld = tyndall::kIdentity;
      scene.camera.clipFromView = toTyndall(convention.convert() * glm::ortho(-3.0, 3.0, -2.0, 2.0, 1.0, 11.0));
      const CameraRays rays(scene.camera, kWidth, kHeight);
      CHECK(rays.reversed() == convention.reversed);
      const Ray ray = rays.ray(0, 15);
      CHECK(glm::length(ray.origin - glm::dvec3(-3 + 0.125, 2 - 0.125, -1)) < 1e-12);
      CHECK(glm::length(ray.direction - glm::dvec3(0, 0, -1)) < 1e-12);
      CHECK(rays.distance(0, 15, convention.depth(0.25)) == Approx(2.5).epsilon(1e-12));
      CHECK(rays.nearToFar(1, 1).end == Approx(10).epsilon(1e-12));
    }
  }
}
