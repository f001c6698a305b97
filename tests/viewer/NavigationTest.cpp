#include "support/Catch.h"

#include <glm/gtc/constants.hpp>
#include <scene/View.h>
#include <viewer/core/Navigation.h>

using namespace viewer;

namespace {

const LookAt kView{{0, 0, 10}, {0, 0, 0}, 60};

double distanceOf(const LookAt& view) { return glm::length(view.eye - view.target); }

} // namespace

TEST_CASE("orbiting goes around the target, turning around the eye") {
  const LookAt right = orbited(kView, glm::half_pi<double>(), 0);
  CHECK(right.target == kView.target);
  CHECK(distanceOf(right) == Approx(10));
  CHECK(std::abs(right.eye.x) == Approx(10));
  const LookAt turn = turned(kView, glm::half_pi<double>(), 0);
  CHECK(turn.eye == kView.eye);
  CHECK(turn.target.x == Approx(10)); // to the right
}

TEST_CASE("a view never stands on its head") {
  LookAt view = kView;
  for (int i = 0; i < 100; ++i)
    view = orbited(view, 0.01, 0.1);
  CHECK(distanceOf(view) == Approx(10));
  CHECK(std::abs(view.target.y - view.eye.y) < 10 * std::sin(1.551));
  for (int i = 0; i < 100; ++i)
    view = turned(view, 0.01, -0.1);
  CHECK(std::isfinite(glm::length(view.target)));
  CHECK(view.eye.x != view.target.x);
}

TEST_CASE("zooming never reaches the target, flying moves both") {
  LookAt view = kView;
  for (int i = 0; i < 1000; ++i)
    view = zoomed(view, 0.5);
  CHECK(distanceOf(view) > 0);
  const LookAt flight = flown(kView, {1, 2, 3});
  CHECK(flight.eye.x == Approx(1));
  CHECK(flight.eye.y == Approx(2));
  CHECK(flight.eye.z == Approx(7));
  CHECK(glm::length(flight.target - flight.eye - (kView.target - kView.eye)) == Approx(0).margin(1e-12));
  CHECK(panned(kView, 0.1, 0).target.x == Approx(1));
}

TEST_CASE("all of the bounds is in a framed view") {
  const host::Bounds bounds{{-3, 0, -50}, {5, 20, 4}};
  for (const double aspect : {0.3, 1.0, 2.5}) {
    const LookAt view = framed(orbited(kView, 0.7, 0.4), bounds, aspect);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 place(corner & 1 ? bounds.low.x : bounds.high.x, corner & 2 ? bounds.low.y : bounds.high.y,
                             corner & 4 ? bounds.low.z : bounds.high.z);
      const glm::dvec3 at = projected(view, aspect, place);
      CAPTURE(aspect, corner);
      CHECK(at.z > 0);
      CHECK(at.x > -1e-9);
      CHECK(at.x < 1 + 1e-9);
      CHECK(at.y > -1e-9);
      CHECK(at.y < 1 + 1e-9);
    }
  }
}

TEST_CASE("rays and projections are each other's inverse, and those of the host's camera") {
  const LookAt view{{1, 2, 3}, {4, 1, -2}, 50};
  const double aspect = 1.7;
  const glm::dvec3 place = view.eye + 6.0 * rayOf(view, aspect, {0.2, 0.9});
  const glm::dvec3 at = projected(view, aspect, place);
  CHECK(at.x == Approx(0.2));
  CHECK(at.y == Approx(0.9));
  const tyndall::Camera camera = host::makeLookAt(view.eye, view.target, view.fovDegrees, aspect, 0.1, 100);
  glm::dmat4 clipFromWorld(0);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      for (int k = 0; k < 4; ++k)
        clipFromWorld[c][r] += camera.clipFromView[static_cast<std::size_t>(4 * k + r)] *
                               camera.viewFromWorld[static_cast<std::size_t>(4 * c + k)];
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(place, 1);
  CHECK(0.5 + 0.5 * clip.x / clip.w == Approx(0.2));
  CHECK(0.5 + 0.5 * clip.y / clip.w == Approx(0.9));
  const LookAt back = lookAtOf(camera, 5);
  CHECK(glm::length(back.eye - view.eye) == Approx(0).margin(1e-9));
  CHECK(back.fovDegrees == Approx(50));
  CHECK(glm::length(glm::normalize(back.target - back.eye) - glm::normalize(view.target - view.eye)) ==
        Approx(0).margin(1e-9));
}
