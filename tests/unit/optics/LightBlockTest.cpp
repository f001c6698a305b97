// A light's uniform block (optics/Blocks.h): its cone, its way through the medium and its shadow views.
#include "OpticsCases.h"
#include "optics/Blocks.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <reference/Optics.h>

using namespace tests;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using tyndall::Frame;
using tyndall::Light;
using tyndall::blocks::LightBlock;
using tyndall::blocks::MapView;
using tyndall::optics::cameraOrigin;
using tyndall::optics::lightBlock;

namespace {

constexpr int kMapWidth = 256, kMapHeight = 192;

Frame frameWith(const Projection& p) { return frameOf(cameraOf(p, {3, -2, 7}, {0.4, -0.2, -1}), 64, 40); }

// As lib/shadow.glsl has it: inside the four sides of a view, or beyond them by no more than the margin; by how much
// least, in clip units. `s` is the way from the light to the point, or for a sun along the ray from its origin.
double insideBy(const MapView& view, const dvec3& point, double s, bool withMargin = true) {
  const dvec4 q = dmat4(view.texelFromCamera) * dvec4(point, 1), margin(withMargin ? view.margin : glm::vec4(0));
  const dvec2 slack = dvec2(margin) + s * dvec2(margin.z, margin.w), size(kMapWidth, kMapHeight), at(q);
  const dvec2 least = glm::min(at + slack, size * q.w - at + slack);
  return std::min(least.x, least.y);
}

dmat4 asFloats(const dmat4& m) { return dmat4(glm::mat4(m)); }

} // namespace

TEST_CASE("a light's colour comes times the scattering, its place relative to the camera") {
  for (const Projection& p : projections()) {
    const Frame frame = frameWith(p);
    Light light = spot({1e5, 2, 3}, {0, 0, -7}, 0.6);
    light.colour = {2, 3, 5};
    light.range = 12;
    const LightBlock block = lightBlock(frame, light, 0, 0);
    CAPTURE(p.name);
    CHECK(block.lightColour.x == Approx(2 * 0.04));
    CHECK(block.lightColour.y == Approx(3 * 0.06));
    CHECK(block.lightColour.z == Approx(5 * 0.1));
    CHECK(dvec3(block.lightDirection) == dvec3(0, 0, -1));
    CHECK(glm::distance(dvec3(block.lightPosition), dvec3(1e5, 2, 3) - cameraOrigin(frame.camera)) < 1e-2);
    CHECK(block.lightRange == 12);
    light.range = tyndall::kInfinity;
    light.colour = {3e38F, 0, 3e38F};
    CHECK(lightBlock(frame, light, 0, 0).lightRange == 0);
    Frame dense = frame;
    dense.medium.constituents[0].scattering = {100, 100, 100};
    CHECK(lightBlock(dense, light, 0, 0).lightColour.x == Approx(3e38)); // a float still
    CHECK(lightBlock(dense, light, 0, 0).viewCount == 0);
  }
}

TEST_CASE("a spot's cone falls off as glTF has it, and a hard one is a step") {
  const Frame frame = frameWith(projections()[0]);
  Random random(51);
  for (int i = 0; i < 50; ++i) {
    Light light = spot({0, 0, 0}, {0, 0, -1}, random.within(0.01, glm::half_pi<double>()));
    light.innerConeAngle = i % 5 == 0 ? light.outerConeAngle : random.within(0, 0.95) * light.outerConeAngle;
    const LightBlock block = lightBlock(frame, light, 0, 0);
    CAPTURE(light.innerConeAngle, light.outerConeAngle);
    CHECK(block.outerSineSquared == Approx(std::pow(std::sin(light.outerConeAngle), 2)));
    CHECK(block.innerSineSquared == Approx(std::pow(std::sin(light.innerConeAngle), 2)));
    CHECK(block.outerCosine >= 0);
    CHECK((block.falloffScale == 0) == (i % 5 == 0));
    if (block.falloffScale == 0) continue;
    for (const double angle : {0.0, 0.3, 0.5, 0.8, 1.2}) {
      const double cosine = std::cos(angle * light.outerConeAngle);
      const double share = (cosine - static_cast<double>(block.outerCosine)) * static_cast<double>(block.falloffScale);
      const double falloff = std::pow(glm::clamp(share, 0.0, 1.0), 2);
      // Cosines of narrow cones are nearly 1, where a float has 6e-8.
      CHECK(falloff == Approx(reference::spotFalloff(light, cosine)).margin(2e-7 * block.falloffScale + 1e-6));
    }
  }
  CHECK(lightBlock(frame, lamp({0, 0, 0}), 0, 0).outerCosine == -1);
}

TEST_CASE("the way through the medium is what lies between the boundary and a point along the light") {
  Random random(52);
  for (const Projection& p : projections()) {
    const Frame frame = frameWith(p);
    Light light = sun(random.direction());
    light.boundary = {true, vec(random.inCube(20)), vec(5.0 * random.direction())};
    const LightBlock block = lightBlock(frame, light, 0, 0);
    CAPTURE(p.name);
    for (int i = 0; i < 20; ++i) {
      const double way = random.within(-30, 30);
      const dvec3 normal = glm::normalize(vec(light.boundary.normal)), aside = glm::cross(normal, random.direction());
      const dvec3 point = vec(light.boundary.point) + 4.0 * aside + way * glm::normalize(vec(light.direction));
      const dvec4 relative(point - cameraOrigin(frame.camera), 1);
      const double steep = std::abs(glm::dot(normal, vec(light.direction)));
      CHECK(glm::dot(dvec4(block.boundary), relative) == Approx(way).margin(1e-5 / steep));
    }
    light.boundary.enabled = false;
    CHECK(lightBlock(frame, light, 0, 0).boundary == glm::vec4(0));
  }
}

TEST_CASE("points come to their texels, with depth that grows away from the light") {
  Random random(53);
  const dvec3 middle(2, 0, -5);
  for (const Projection& p : projections()) {
    const Frame frame = frameWith(p);
    for (Light light : {sun({0.3, -1, 0.2}), spot({2, 8, -4}, {0, -1, -0.2}, 0.8), lamp({1, 3, -4})}) {
      addViews(light, p.convention, middle, 20);
      const LightBlock block = lightBlock(frame, light, kMapWidth, kMapHeight);
      REQUIRE(block.viewCount == static_cast<int>(light.shadow.views.size()));
      for (int v = 0; v < block.viewCount; ++v) {
        const MapView& view = block.shadowViews[v];
        CAPTURE(p.name, static_cast<int>(light.kind), v);
        CHECK(view.layer == v);
        CHECK(view.isOpen == (light.kind != tyndall::LightKind::Directional || v + 1 == block.viewCount ? 1 : 0));
        CHECK(view.farDepth - view.nearDepth == 1);
        CHECK(view.depthSign == (p.convention.reversed ? -1 : 1));
        const dmat4 clipFromWorld = host::fromMat4(light.shadow.views[static_cast<std::size_t>(v)].clipFromWorld);
        for (int i = 0; i < 20; ++i) {
          const dvec3 point = middle + random.inCube(15);
          const dvec4 clip = clipFromWorld * dvec4(point, 1);
          if (clip.w < 0.05 || std::max(std::abs(clip.x), std::abs(clip.y)) > 2 * clip.w) continue;
          const dvec4 q = dmat4(view.texelFromCamera) * dvec4(point - cameraOrigin(frame.camera), 1);
          CHECK(q.x / q.w == Approx((0.5 * clip.x / clip.w + 0.5) * kMapWidth).margin(1e-3 / clip.w));
          CHECK(q.y / q.w == Approx((0.5 * clip.y / clip.w + 0.5) * kMapHeight).margin(1e-3 / clip.w));
          const double z = clip.z / clip.w, near = host::ndcNear(p.convention), far = host::ndcFar(p.convention);
          const double share = (z - near) / (far - near); // 0 at the near plane, 1 at the far one
          CHECK((q.z / q.w - static_cast<double>(view.nearDepth)) == Approx(share).margin(1e-4 / clip.w));
        }
      }
    }
  }
}

TEST_CASE("a shadow map is seen as exactly far from the world's origin as at it") {
  for (const Projection& p : projections()) {
    Frame frame = frameWith(p);
    frame.lights = {spot({2, 8, -4}, {0, -1, -0.2}, 0.8)};
    addViews(frame.lights[0], p.convention, {2, 0, -5}, 20);
    const Frame far = placed(frame, {glm::dmat3(1), 1, {3e6, -2e6, 1e6}});
    const MapView here = lightBlock(frame, frame.lights[0], kMapWidth, kMapHeight).shadowViews[0];
    const MapView there = lightBlock(far, far.lights[0], kMapWidth, kMapHeight).shadowViews[0];
    CAPTURE(p.name);
    for (int i = 0; i < 4; ++i)
      CHECK(glm::distance(here.texelFromCamera[i], there.texelFromCamera[i]) < 1e-2F);
  }
}

TEST_CASE("depth of curves is linear from the near to the far plane, of camera-relative points") {
  for (const Projection& p : projections()) {
    const Frame frame = frameWith(p);
    Light light = spot({2, 8, -4}, {0, -1, 0}, 0.8);
    addViews(light, p.convention, {0, 0, 0}, 10); // from 0.1 to 30 below the lamp
    light.curves.nodes = 8;
    const LightBlock block = lightBlock(frame, light, kMapWidth, kMapHeight, 32);
    CAPTURE(p.name);
    CHECK(block.curvesSize == 32);
    CHECK(block.texelsPerCurve == 2);
    for (const double depth : {0.1, 4.0, 30.0}) {
      const dvec4 point(dvec3(1, 8 - depth, -3) - cameraOrigin(frame.camera), 1);
      CHECK(glm::dot(dvec4(block.shadowViews[0].curveDepth), point) == Approx((depth - 0.1) / 29.9).margin(1e-6));
    }
    light.curves.packed = false;
    CHECK(lightBlock(frame, light, kMapWidth, kMapHeight, 32).texelsPerCurve == 4);
    CHECK(lightBlock(frame, light, kMapWidth, kMapHeight).shadowViews[0].curveDepth == glm::vec4(0));
  }
}

// Where two faces meet, with matrices as an engine's floats have them, far from the world's origin.
TEST_CASE("the faces of a cube leave no gap, and the margin that sees to it is narrow") {
  Random random(54);
  for (const double offset : {0.0, 1e2, 1e4}) {
    Frame frame = frameWith(projections()[0]);
    const dvec3 position = dvec3(1, 3, -4) + offset;
    frame.camera = cameraOf(projections()[0], position + dvec3(5, -2, 6), {-1, 0, -1});
    Light light = lamp(position);
    addViews(light, kConventions[0], position, 20);
    for (tyndall::ShadowView& view : light.shadow.views)
      view.clipFromWorld = host::toMat4(asFloats(host::fromMat4(view.clipFromWorld)));
    const LightBlock block = lightBlock(frame, light, kMapWidth, kMapHeight);
    int gaps = 0, apart = 0;
    for (int i = 0; i < 3000; ++i) {
      dvec3 direction = random.direction();
      direction[i % 3] = (i % 2 ? 1.0 : -1.0) * std::abs(direction[(i + 1) % 3]); // where two or three faces meet
      const double s = random.within(0.3, 50);
      const dvec3 point = dvec3(block.lightPosition) + s * direction;
      double best = -1e300, bare = -1e300;
      for (int v = 0; v < 6; ++v) {
        best = std::max(best, insideBy(block.shadowViews[v], point, s));
        bare = std::max(bare, insideBy(block.shadowViews[v], point, s, false));
      }
      gaps += best < 0 ? 1 : 0;
      apart += bare < 0 ? 1 : 0;
      for (int v = 0; v < 6; ++v) { // in texels: beside the lamp's own offset, which no margin makes good
        const dvec4 margin(block.shadowViews[v].margin);
        CHECK(margin.z < 1e-5 * kMapWidth);
        CHECK(margin.x < 1e-5 * kMapWidth * (20 + offset));
      }
    }
    CAPTURE(offset, apart);
    CHECK(gaps == 0);
    CHECK(apart > 0); // without the margin there would be some
  }
}

TEST_CASE("a view whose centre is elsewhere than its lamp is as it is meant") {
  const Frame frame = frameWith(projections()[0]);
  Light light = spot({2, 8, -4}, {0, -1, 0}, 0.8), aside = light;
  addViews(light, kConventions[0], {0, 0, 0}, 10);
  aside.position = {2.5, 8, -4};
  addViews(aside, kConventions[0], {0, 0, 0}, 10);
  std::swap(aside.shadow.views, light.shadow.views); // each has the other's
  for (const Light& one : {light, aside}) {
    const MapView view = lightBlock(frame, one, kMapWidth, kMapHeight).shadowViews[0];
    CHECK(view.margin.x < 0.02F); // of a side that passes the lamp at half a unit, 64 texels
    CHECK(view.margin.y < 0.02F);
  }
}
