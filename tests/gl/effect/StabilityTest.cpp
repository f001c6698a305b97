// Where formulas break: singular positions, aligned directions, extreme scales, NaN and Inf in what the engine hands
// in. Everything stays finite, keeps to its own pixel, and equals the reference where that is finite.
#include "AgainstReference.h"
#include "reference/CameraRays.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

constexpr int kX = 10, kY = 7; // the pixel that things happen to

const std::vector<LightKind> kKinds = {LightKind::Directional, LightKind::Point, LightKind::Spot};

Vec3 toVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

reference::Ray pixelRay(const tests::SceneRig& rig) {
  return reference::CameraRays(rig.frame.camera, rig.frame.viewport.width, rig.frame.viewport.height).ray(kX, kY);
}

double surfaceDistance(const tests::SceneRig& rig) {
  const reference::CameraRays rays(rig.frame.camera, rig.frame.viewport.width, rig.frame.viewport.height);
  return rays.distance(kX, kY, rig.depth()[static_cast<std::size_t>(kY * rig.frame.viewport.width + kX)]);
}

} // namespace

TEST_CASE("a scene of another unit gives the same picture") {
  for (const double scale : {1e-3, 1e3, 1e-6, 1e6})
    for (const LightKind kind : kKinds)
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
        CAPTURE(scale, static_cast<int>(kind), static_cast<int>(filter));
        tests::SceneRig rig;
        Light& light = rig.addLight(kind, tests::Casters::Blocks, true);
        light.range = 8;
        if (kind == LightKind::Directional) light.boundary = {true, {0, 2, 0}, {0, 1, 0}};
        rig.frame.medium.farDistance = 30;
        rig.frame.settings.shadowFilter = filter;
        const reference::ImageAnswer expected = rig.render();
        tests::transformWorld(rig.frame, scale, glm::dvec3(0));
        const reference::ImageAnswer answer = rig.render();
        CHECK(tests::difference(answer.inscatter, expected.inscatter) <= 1e-4);
        CHECK(tests::difference(answer.transmittance, expected.transmittance) <= 1e-6);
      }
}

TEST_CASE("a point light at the eye, on a ray, at a surface or behind it") {
  struct Place {
    const char* name;
    std::function<double(const tests::SceneRig&)> alongRay; // distance from the eye, along the ray of the pixel
  };
  const std::vector<Place> places = {{"at the eye", [](const tests::SceneRig&) { return 0.0; }},
                                     {"1e-6 before the eye", [](const tests::SceneRig&) { return 1e-6; }},
                                     {"on a pixel's ray", [](const tests::SceneRig&) { return 2.5; }},
                                     {"at the surface", surfaceDistance},
                                     {"behind the surface", [](const tests::SceneRig&) { return 12.0; }},
                                     {"behind the eye", [](const tests::SceneRig&) { return -2.0; }}};
  for (const Place& place : places)
    for (const LightKind kind : {LightKind::Point, LightKind::Spot})
      for (const tests::Casters casters : {tests::Casters::None, tests::Casters::Blocks}) {
        CAPTURE(place.name, static_cast<int>(kind), static_cast<int>(casters));
        tests::SceneRig rig;
        Light& light = rig.addLight(kind, casters);
        const reference::Ray ray = pixelRay(rig);
        light.position = toVec3(ray.at(place.alongRay(rig)));
        if (casters == tests::Casters::Blocks) light.shadow.views = tests::shadowViewsOf(light);
        if (place.alongRay(rig) == 0.0)
          tests::checkFinite(rig); // every ray runs through the light: infinite but for the floor of 1 / h
        else
          tests::checkAgainstReference(rig, 1e-3);
      }
}

TEST_CASE("a spot light aimed along or against the view ray") {
  for (const double sign : {1.0, -1.0})
    for (const double along : {0.0, 2.5, 12.0, -2.0})
      for (const double sideways : {0.0, 1e-4, 0.5}) {
        CAPTURE(sign, along, sideways);
        tests::SceneRig rig;
        Light& light = rig.addLight(LightKind::Spot);
        const reference::Ray ray = pixelRay(rig);
        light.position = toVec3(ray.at(along) + glm::dvec3(sideways, 0, 0));
        light.direction = toVec3(sign * ray.direction);
        light.shadow.views = tests::shadowViewsOf(light);
        if (along == 0.0 && sideways < 0.1)
          tests::checkFinite(rig);
        else
          tests::checkAgainstReference(rig, 1e-3);
      }
}

TEST_CASE("a sun along, against and perpendicular to the view axis") {
  tests::SceneRig plain;
  const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(plain.frame.camera.viewFromWorld));
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
        CAPTURE(axis, sign, static_cast<int>(filter));
        tests::SceneRig rig(25, 17); // the middle pixel looks along the axis
        Light& light = rig.addLight(LightKind::Directional);
        light.direction = toVec3(sign * glm::dvec3(worldFromView[axis]));
        light.shadow.views = tests::shadowViewsOf(light);
        rig.frame.settings.shadowFilter = filter;
        if (filter == ShadowFilter::Nearest) {
          tests::checkAgainstReference(rig, 1e-3);
          continue;
        }
        tests::checkFinite(rig);
        const reference::ErrorMetrics error = reference::compare(rig.outputs().inscatter, rig.reference().inscatter);
        INFO(error.text());
        CHECK(error.rRmse <= 1e-3);
        CHECK(error.p99 <= 5e-3);
      }
}

TEST_CASE("a camera on a shadow view's near plane, far plane and plane of no projection") {
  const glm::dvec3 eye(0, 1, 6);
  for (const LightKind kind : {LightKind::Directional, LightKind::Spot})
    for (const double share : {0.0, 0.5, 1.0}) { // of the eye's distance along the light's axis
      CAPTURE(static_cast<int>(kind), share);
      tests::SceneRig rig;
      Light& light = rig.addLight(kind);
      light.position = {0.3, 1.2, 6 - 2.0 * share};
      light.direction = {0, 0, share > 0 ? 1.0 : -1.0}; // share 0: the eye is in the plane w = 0
      if (kind == LightKind::Spot) {
        const glm::dvec3 position = reference::toVec3(light.position), axis = reference::toVec3(light.direction);
        const double distance = std::max(0.1, glm::dot(eye - position, axis));
        light.shadow.views[0].clipFromWorld =
            tests::toMat4(glm::perspective(1.3, 1.0, share == 0.5 ? distance / 2 : distance, 2 * distance + 10) *
                          glm::lookAt(position, position + axis, glm::dvec3(0, 1, 0)));
      } else {
        const glm::dmat4 view = glm::lookAt(eye, eye + reference::toVec3(light.direction), glm::dvec3(0, 1, 0));
        light.shadow.views[0].clipFromWorld = tests::toMat4(
            glm::ortho(-6.0, 6.0, -6.0, 6.0, share == 1.0 ? -20.0 : 0.0, share == 1.0 ? 0.0 : 20.0) * view);
      }
      tests::checkAgainstReference(rig, 1e-3);
    }
}

TEST_CASE("a lamp at the eye lights nothing outside its cone, wherever rounding of the camera's matrix puts it") {
  for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(123.4, -56.7, 891.2), glm::dvec3(1e6, 3e5, -2e6)})
    for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0.1, 0.2}})
      for (const double outer : {0.02, 0.6}) {
        CAPTURE(offset.x, direction[0], direction[2], outer);
        tests::SceneRig rig;
        Light& light = rig.addLight(LightKind::Spot, tests::Casters::None);
        light.direction = direction;
        light.outerConeAngle = outer;
        light.innerConeAngle = 0.5 * outer;
        tests::transformWorld(rig.frame, 1, offset);
        rig.frame.lights[0].position =
            toVec3(glm::dvec3(glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld))[3]));
        for (const Technique technique : {Technique::Exact, Technique::Tree, Technique::Epipolar}) {
          rig.frame.settings.technique = technique;
          const reference::Image image = rig.render().inscatter;
          CHECK(std::count(image.rgb.begin(), image.rgb.end(), 0.0) == static_cast<std::ptrdiff_t>(image.rgb.size()));
        }
      }
}

// On a border either texel may count: the picture lies between those of a camera a little to either side.
TEST_CASE("rays along the shadow map's axes and exactly on texel borders") {
  for (const bool orthographic : {false, true})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CAPTURE(orthographic, static_cast<int>(filter));
      tests::SceneRig rig(25, 17);
      Light& light = rig.addLight(LightKind::Directional);
      light.direction = {0, -1, 0};
      light.shadow.views[0].clipFromWorld =
          tests::toMat4(glm::ortho(-8.0, 8.0, -8.0, 8.0, 0.0, 16.0) *
                        glm::lookAt(glm::dvec3(0, 8, 0), glm::dvec3(0), glm::dvec3(0, 0, -1)));
      rig.frame.settings.shadowFilter = filter;
      tests::DepthConvention convention = rig.convention();
      convention.orthographic = orthographic;
      convention.infinite = !orthographic;
      rig.setConvention(convention);
      const auto at = [&](double x) { rig.frame.camera.viewFromWorld = tests::lookAt({x, 1, 6}, {x, 1, 0}); };
      at(1e-5);
      const reference::Image right = rig.reference().inscatter;
      at(-1e-5);
      const reference::Image left = rig.reference().inscatter;
      at(0);
      tests::checkFinite(rig);
      const reference::Image image = rig.outputs().inscatter;
      const double slack = (filter == ShadowFilter::Nearest ? 1e-3 : 2e-2) * tests::median(right.rgb);
      for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        CHECK(image.rgb[i] >= std::min(left.rgb[i], right.rgb[i]) - slack);
        CHECK(image.rgb[i] <= std::max(left.rgb[i], right.rgb[i]) + slack);
      }
    }
}

TEST_CASE("extinction from next to nothing to nearly opaque") {
  for (const float sigma : {1e-30F, 1e-12F, 1e-6F, 1e3F, 1e6F})
    for (const LightKind kind : kKinds) {
      CAPTURE(sigma, static_cast<int>(kind));
      tests::SceneRig rig;
      rig.addLight(kind);
      rig.frame.medium.constituents = {{{sigma, 0.5F * sigma, 0.1F * sigma}, Phase::HenyeyGreenstein, 0.3F}};
      rig.frame.medium.farDistance = 100;
      tests::checkAgainstReference(rig, 1e-3);
    }
}

TEST_CASE("a light that ends before the ray, and the widest and narrowest cones") {
  for (const LightKind kind : {LightKind::Point, LightKind::Spot})
    for (const double range : {1e-6, 0.5, 2.0, 1e6}) {
      CAPTURE(static_cast<int>(kind), range);
      tests::SceneRig rig;
      rig.addLight(kind).range = range;
      tests::checkAgainstReference(rig, 1e-3);
    }
  for (const double outer : {glm::half_pi<double>(), 1.5, 1e-2, 1e-4})
    for (const double inner : {0.0, 0.5, 1.0})
      for (const Vec3& direction : {Vec3{0.4, -1, -0.3}, Vec3{0, -1, 0}, Vec3{0.12, -0.2, 0.97}}) {
        CAPTURE(outer, inner, direction[0]);
        tests::SceneRig rig;
        Light& light = rig.addLight(LightKind::Spot, tests::Casters::None);
        light.direction = direction;
        light.outerConeAngle = outer;
        light.innerConeAngle = inner * outer;
        tests::checkAgainstReference(rig, 1e-3);
      }
}

TEST_CASE("values at the ends of float32 stay finite") {
  struct Extreme {
    const char* name;
    std::function<void(Frame&)> set;
  };
  const std::vector<Extreme> extremes = {
      {"bright", [](Frame& f) { f.lights[0].colour = {3e38F, 3e38F, 1e-38F}; }},
      {"far light", [](Frame& f) { f.lights[0].position = {1e30, -1e25, 3e38}; }},
      {"light beyond float32", [](Frame& f) { f.lights[0].position = {1e200, 0, 0}; }},
      {"long direction", [](Frame& f) { f.lights[0].direction = {1e200, -3e250, 1e100}; }},
      {"short direction", [](Frame& f) { f.lights[0].direction = {1e-200, -3e-250, 1e-200}; }},
      {"long range", [](Frame& f) { f.lights[0].range = 1e300; }},
      {"short range", [](Frame& f) { f.lights[0].range = 1e-300; }},
      {"thin", [](Frame& f) { f.medium.constituents[0].scattering = {1e-38F, 1e-45F, 1e-30F}; }},
      {"thick", [](Frame& f) { f.medium.constituents[0].scattering = {1e30F, 3e38F, 1e20F}; }},
      {"black", [](Frame& f) { f.medium.absorption = {3e38F, 3e38F, 3e38F}; }},
      {"thick and black",
       [](Frame& f) {
         f.medium.constituents[0].scattering = f.medium.constituents[1].scattering = {3e38F, 3e38F, 3e38F};
         f.medium.absorption = {3e38F, 3e38F, 3e38F};
       }},
      {"far sky", [](Frame& f) { f.medium.farDistance = 1e300; }},
      {"near sky", [](Frame& f) { f.medium.farDistance = 1e-300; }},
      {"sharp forward peak", [](Frame& f) { f.medium.constituents[0].g = std::nextafter(1.0F, 0.0F); }},
      {"sharp backward peak", [](Frame& f) { f.medium.constituents[0].g = std::nextafter(-1.0F, 0.0F); }},
  };
  for (const LightKind kind : kKinds)
    for (const tests::Casters casters : {tests::Casters::None, tests::Casters::Blocks})
      for (const Extreme& extreme : extremes) {
        CAPTURE(static_cast<int>(kind), static_cast<int>(casters), extreme.name);
        tests::SceneRig rig;
        rig.addLight(kind, casters);
        extreme.set(rig.frame);
        tests::checkFinite(rig);
      }
}

TEST_CASE("a spot along an orthographic camera's rays lights nothing outside its cone") {
  for (const double turn : {0.0, 1e-9, 1e-7, 3e-4})
    for (const double side : {-1.0, 1.0}) {
      CAPTURE(turn, side);
      tests::SceneRig rig;
      tests::DepthConvention convention;
      convention.orthographic = true;
      rig.setConvention(convention);
      Light& light = rig.addLight(LightKind::Spot, tests::Casters::None);
      const glm::dmat4 worldFromView = glm::inverse(reference::toMat4(rig.frame.camera.viewFromWorld));
      light.position = toVec3(glm::dvec3(worldFromView * glm::dvec4(-0.13, 0.21, -5, 1)));
      light.direction = toVec3(glm::dvec3(worldFromView * glm::dvec4(turn, 0.3 * turn, side, 0)));
      light.innerConeAngle = 0.3F;
      light.outerConeAngle = 0.5F;
      rig.render();
      tests::checkAgainstReference(rig, 1e-3);
    }
}

TEST_CASE("where an orthographic camera's far plane is changes nothing of what is near") {
  for (const LightKind kind : kKinds) {
    CAPTURE(static_cast<int>(kind));
    for (const double far : {40.0, 1e4, 1e7}) {
      CAPTURE(far);
      tests::SceneRig rig;
      tests::DepthConvention convention;
      convention.orthographic = true;
      convention.far = far;
      for (double& distance : rig.distances)
        distance = std::min(distance, 30.0); // no sky, whose rays end at the far plane or before
      rig.setConvention(convention);
      rig.addLight(kind);
      rig.render();
      tests::checkAgainstReference(rig, 1e-3);
    }
  }
}
