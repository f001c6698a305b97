// What of a light the camera sees (optics/LightVolume.h): known answers, and bounds against many points and rays.
#include "optics/LightVolume.h"

#include "OpticsCases.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <reference/CameraRays.h>
#include <reference/Optics.h>

using namespace tests;
using glm::dvec3;
using tyndall::Camera;
using tyndall::Frame;
using tyndall::Light;
using tyndall::optics::brightestInscatter;
using tyndall::optics::isOutOfView;
using tyndall::optics::shareOf;

namespace {

const dvec3 kEye(3, -2, 7), kDirection(0.4, -0.2, -1);

Camera cameraAt(const Projection& p) { return cameraOf(p, kEye, kDirection); }

// A perspective camera at the origin along -z, tangents 0.8 and 0.5; its near plane at 0.1 is none to rays.
Camera plainCamera() { return cameraOf(projections()[0], {0, 0, 0}, {0, 0, -1}); }

Light ball(const dvec3& position, double range) {
  Light light = lamp(position);
  light.range = range;
  return light;
}

Light randomLight(Random& random) {
  const dvec3 position = kEye + random.inCube(30);
  if (random.within(0, 1) < 0.5) return ball(position, random.within(0.1, 15));
  Light light = spot(position, random.direction(), random.within(0.05, glm::half_pi<double>()));
  if (random.within(0, 1) < 0.7) light.range = random.within(1, 30);
  return light;
}

// A point that the light reaches.
dvec3 reachedPoint(const Light& light, Random& random) {
  const double range = std::isfinite(light.range) ? light.range : 200;
  dvec3 direction = random.direction();
  if (light.kind == tyndall::LightKind::Spot) {
    const dvec3 axis = glm::normalize(vec(light.direction)), across = glm::normalize(glm::cross(axis, direction));
    const double angle = light.outerConeAngle * std::sqrt(random.within(0, 1));
    direction = std::cos(angle) * axis + std::sin(angle) * across;
  }
  return vec(light.position) + range * std::cbrt(random.within(0, 1)) * direction;
}

// True if a camera ray runs through it: those of a perspective camera begin at the eye.
bool isSeen(const Frame& frame, const Projection& p, const dvec3& point) {
  const Seen seen = seenAt(frame, point);
  const bool inImage = seen.w > 0 && seen.window.x >= 0 && seen.window.x <= frame.viewport.width &&
                       seen.window.y >= 0 && seen.window.y <= frame.viewport.height;
  const double near = p.convention.reversed ? 1 - seen.depth : seen.depth;
  return inImage && (!p.orthographic || near >= 0);
}

} // namespace

TEST_CASE("balls and cones beside, behind and before a camera are told apart") {
  const Camera camera = plainCamera();
  CHECK_FALSE(isOutOfView(sun({0, 1, 0}), camera));
  CHECK_FALSE(isOutOfView(lamp({0, 0, 50}), camera)); // without a range it reaches everywhere
  CHECK_FALSE(isOutOfView(ball({0, 0, -5}, 1), camera));
  CHECK_FALSE(isOutOfView(ball({0, 0, -1e6}, 1), camera)); // no far plane ends a ray
  CHECK(isOutOfView(ball({0, 0, 5}, 4.9), camera));        // behind the eye
  CHECK_FALSE(isOutOfView(ball({0, 0, 5}, 5.1), camera));  // around it
  CHECK_FALSE(isOutOfView(ball({0, 0, -0.05}, 0.01), camera));
  // The right side's plane is x = -0.8 z: a ball beside it, at (x, 0, -10), is (x - 8) / |(1, 0.8)| from it.
  const double slope = std::hypot(1, 0.8);
  CHECK(isOutOfView(ball({12, 0, -10}, 4 / slope - 1e-3), camera));
  CHECK_FALSE(isOutOfView(ball({12, 0, -10}, 4 / slope + 1e-3), camera));
  // Beside the edge between the right and the top side, 10.517 away from it.
  CHECK(isOutOfView(ball({18, 15, -10}, 10.4), camera));
  CHECK_FALSE(isOutOfView(ball({18, 15, -10}, 10.6), camera));

  CHECK(isOutOfView(spot({12, 0, -10}, {1, 0, 0}, 0.5), camera)); // away from the view
  CHECK_FALSE(isOutOfView(spot({12, 0, -10}, {-1, 0, 0}, 0.5), camera));
  const double along = std::atan(1 / 0.8); // between the spot's axis +x and the right side, which it nears at infinity
  CHECK(isOutOfView(spot({12, 0, -10}, {1, 0, 0}, along - 1e-3), camera));
  CHECK_FALSE(isOutOfView(spot({12, 0, -10}, {1, 0, 0}, along + 1e-3), camera));
  CHECK(isOutOfView(spot({0, 0, 5}, {0, 0, 1}, 1.5), camera)); // nearly a half space, behind the eye
  CHECK_FALSE(isOutOfView(spot({0, 0, -5}, {0, 0, 1}, glm::half_pi<double>()), camera));
}

TEST_CASE("an orthographic camera's rays begin at its near plane and run beyond its far one, in every convention") {
  for (const Projection& p : projections()) { // planes at 0.1 and 60, 16 wide and 10 high
    if (!p.orthographic) continue;
    const Camera camera = cameraOf(p, {0, 0, 0}, {0, 0, -1});
    CAPTURE(p.name);
    CHECK_FALSE(isOutOfView(ball({7, 4, -90}, 1), camera));
    CHECK_FALSE(isOutOfView(ball({7, 4, -30}, 1), camera));
    CHECK_FALSE(isOutOfView(ball({0, 0, 0.8}, 1), camera));
    CHECK(isOutOfView(ball({0, 0, 1}, 1), camera));
    CHECK(isOutOfView(ball({0, 6.1, -30}, 1), camera));
    CHECK(isOutOfView(ball({-9.1, 0, -30}, 1), camera));
    CHECK_FALSE(isOutOfView(ball({-8.9, 0, -30}, 1), camera));
    CHECK(isOutOfView(spot({-9, 0, -30}, {-1, 0, 0}, 1), camera));
  }
}

TEST_CASE("a mirrored picture shows the same lights") {
  Random random(65);
  glm::dmat4 mirror(1);
  mirror[0][0] = -1;
  int out = 0;
  for (const Projection& p : projections()) {
    const Camera camera = cameraAt(p);
    Camera mirrored = camera;
    mirrored.clipFromView = host::toMat4(mirror * p.clipFromView);
    for (int i = 0; i < 40; ++i) {
      const Light light = randomLight(random);
      CAPTURE(p.name, i);
      CHECK(isOutOfView(light, mirrored) == isOutOfView(light, camera));
      CHECK(shareOf(light, mirrored, {}).area == Approx(shareOf(light, camera, {}).area).margin(0.5 / 144));
      out += isOutOfView(light, camera) ? 1 : 0;
    }
  }
  CHECK(out > 100);
}

TEST_CASE("no light is out of view that reaches a point that a ray sees; few others are kept") {
  Random random(61);
  int out = 0, keptInVain = 0;
  for (const Projection& p : projections()) {
    const Frame frame = frameOf(cameraAt(p), 64, 40);
    for (int i = 0; i < 150; ++i) {
      const Light light = randomLight(random);
      bool seen = false;
      for (int k = 0; k < 400 && !seen; ++k)
        seen = isSeen(frame, p, reachedPoint(light, random));
      const bool isOut = isOutOfView(light, frame.camera);
      CAPTURE(p.name, i);
      CHECK_FALSE((seen && isOut));
      out += isOut ? 1 : 0;
      keptInVain += !isOut && !seen ? 1 : 0;
    }
  }
  CHECK(out > 600);
  CHECK(keptInVain < out / 5); // or that no point happened to show
}

TEST_CASE("what is out of view stays so when the world is turned, moved or measured in other units") {
  Random random(62);
  for (const Projection& p : projections())
    for (int i = 0; i < 40; ++i) {
      Frame frame = frameOf(cameraAt(p), 64, 40);
      frame.lights = {randomLight(random)};
      const bool out = isOutOfView(frame.lights[0], frame.camera);
      for (const double scale : {1e-6, 1.0, 1e6}) {
        const Frame other = placed(frame, {turned(random), scale, scale * random.inCube(30)});
        CAPTURE(p.name, i, scale);
        CHECK(isOutOfView(other.lights[0], other.camera) == out);
      }
    }
}

TEST_CASE("a light's share of the image is that of the rays that meet its ball") {
  Random random(63);
  for (const Projection& p : projections()) {
    const Camera camera = cameraAt(p);
    const reference::CameraRays rays(camera, 64, 36);
    for (int i = 0; i < 20; ++i) {
      const Light light = ball(kEye + 15.0 * glm::normalize(kDirection) + random.inCube(12), random.within(1, 9));
      int met = 0;
      for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) {
          const reference::Ray ray = rays.ray(x, y);
          const dvec3 from = vec(light.position) - ray.origin;
          const double foot = std::max(glm::dot(from, ray.direction), 0.0);
          met += glm::distance(from, foot * ray.direction) <= light.range ? 1 : 0;
        }
      const double area = met / (64.0 * 36);
      CAPTURE(p.name, i, light.range);
      CHECK(shareOf(light, camera, {}).area == Approx(area).margin(0.04));
    }
  }
}

TEST_CASE("a cone has the share of the image that it covers from the eye, a light out of view hardly any") {
  Camera camera = plainCamera();
  // From the eye along the view a cone is a disc, of pi tan^2 over an image of 1.6 x 1.0.
  for (const double angle : {0.2, 0.3, 0.4})
    CHECK(shareOf(spot({0, 0, -1e-3}, {0, 0, -1}, angle), camera, {}).area ==
          Approx(glm::pi<double>() * std::pow(std::tan(angle), 2) / 1.6).margin(0.03));
  CHECK(shareOf(ball({0, 0, 50}, 3), camera, {}).area == Approx(0.5 / 144));
  CHECK(shareOf(lamp({0, 0, 50}), camera, {}).area == 1);
}

TEST_CASE("a light is worth its irradiance over an optical depth or a ray, a lamp's by its distance and angle") {
  const Camera camera = plainCamera();
  tyndall::Medium medium;
  medium.constituents = {{{0.25F, 0.5F, 0}}};
  Light light = sun({0, -1, 0});
  light.colour = {1, 3, 2};
  CHECK(shareOf(light, camera, medium).area == 1);
  CHECK(shareOf(light, camera, medium).brightness == Approx(3 / 0.25)); // of the clearest channel that is dimmed
  medium.farDistance = 2;
  CHECK(shareOf(light, camera, medium).brightness == Approx(6));
  CHECK(shareOf(light, camera, {}).brightness == Approx(3e15));
  Light near = lamp({0, 0, -4}), far = lamp({0, 0, -8});
  CHECK(shareOf(near, camera, medium).brightness == Approx(glm::pi<double>() / 4));
  CHECK(shareOf(far, camera, medium).brightness == Approx(glm::pi<double>() / 8));
  CHECK(shareOf(spot({0, 0, -4}, {0, 0, 1}, 0.4), camera, medium).brightness == Approx(0.8 / 4));
}

// Where pixels are smallest, at a corner, half a pixel from a lamp's centre.
TEST_CASE("the brightest inscatter of a lamp is that of a ray half a pixel beside it") {
  for (const Projection& p : projections()) {
    Frame frame = frameOf(cameraAt(p), 64, 40);
    frame.medium = {};
    frame.medium.constituents = {{{1e-4F, 1e-4F, 1e-4F}}};
    glm::dvec4 corner = glm::inverse(p.clipFromView) * glm::dvec4(0.97, 0.96, 0.5, 1);
    corner = glm::dvec4(dvec3(corner) / corner.w, 1);
    corner = glm::dvec4(dvec3(corner) * (p.orthographic ? 1 : 20 / glm::length(dvec3(corner))), 1);
    const dvec3 position = glm::inverse(host::fromMat4(frame.camera.viewFromWorld)) * corner;
    frame.lights = {lamp(position)};
    const glm::dvec2 place = seenAt(frame, position).window;
    double brightest = 0;
    for (int i = 0; i < 64; ++i) {
      const double angle = glm::pi<double>() * i / 32;
      const glm::dvec2 window = place + 0.5 * glm::dvec2(std::cos(angle), std::sin(angle));
      // In the middle of the one pixel of another image.
      Camera one = frame.camera;
      glm::dmat4 toWindow(1); // the window to the centre of the image
      toWindow[3][0] = 1 - window.x / 32;
      toWindow[3][1] = 1 - window.y / 20;
      one.clipFromView = host::toMat4(toWindow * p.clipFromView);
      const reference::Ray ray = reference::CameraRays(one, 1, 1).ray(0, 0);
      brightest = std::max(brightest, reference::Airlight(frame.medium, frame.lights[0], ray).span(0, 1e5).x);
    }
    const double bound = brightestInscatter(frame, frame.lights[0]);
    CAPTURE(p.name);
    CHECK(brightest <= bound);
    CHECK(brightest > 0.5 * bound);
  }
}

TEST_CASE("no ray of a picture brings more than the brightest inscatter, and some bring nearly that") {
  Random random(64);
  double nearest = 0; // share of the bound that a sun's ray reaches
  for (const Projection& p : projections())
    for (int i = 0; i < 12; ++i) {
      Frame frame = frameOf(cameraAt(p), 16, 10);
      frame.medium.constituents[0].g = static_cast<float>(random.within(-0.8, 0.8));
      frame.lights = {i % 3 == 0   ? sun(i % 2 ? kDirection : -kDirection)
                      : i % 3 == 1 ? lamp(kEye + random.inCube(10))
                                   : spot(kEye + random.inCube(10), random.direction(), 1)};
      for (const double scale : {1e-6, 1.0, 1e6}) {
        const Frame one = placed(frame, {glm::dmat3(1), scale, dvec3(0)});
        const Light& light = one.lights[0];
        const double bound = brightestInscatter(one, light);
        const reference::CameraRays rays(one.camera, one.viewport.width, one.viewport.height);
        CAPTURE(p.name, i, scale);
        for (int y = 0; y < one.viewport.height; ++y)
          for (int x = 0; x < one.viewport.width; ++x) {
            const reference::Ray ray = rays.ray(x, y);
            if (light.kind != tyndall::LightKind::Directional) {
              const Seen place = seenAt(one, vec(light.position));
              if (glm::distance(place.window, {x + 0.5, y + 0.5}) < 0.5) continue; // the lamp itself
            }
            const reference::Rgb rgb = reference::Airlight(one.medium, light, ray).span(0, tyndall::kInfinity);
            const double most = std::max({rgb.x, rgb.y, rgb.z});
            CHECK(most <= bound * (1 + 1e-6));
            if (light.kind == tyndall::LightKind::Directional) nearest = std::max(nearest, most / bound);
          }
      }
    }
  CHECK(nearest > 0.9);
}
