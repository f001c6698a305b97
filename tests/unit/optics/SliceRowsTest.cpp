// The rows of slices through shadow maps, and how slices hold values (optics/Slices.h).
#include "OpticsCases.h"
#include "SliceScenes.h"
#include "optics/Blocks.h"
#include "support/Catch.h"

#include <cmath>
#include <optional>

using namespace tests;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using tyndall::Frame;
using tyndall::Light;
using tyndall::optics::makeSlices;
using tyndall::optics::SliceTable;

namespace {

constexpr int kMapWidth = 256, kMapHeight = 192;

struct WorldRay {
  dvec3 begin, along; // unit
};

// The camera ray through a window position, from where view z is 0: the eye, if there is one.
WorldRay rayThrough(const Frame& frame, const dvec2& window) {
  const dmat4 view = host::fromMat4(frame.camera.viewFromWorld), clip = host::fromMat4(frame.camera.clipFromView);
  const dvec2 ndc = 2.0 * window / dvec2(frame.viewport.width, frame.viewport.height) - 1.0;
  const auto at = [&](double z) {
    const glm::dvec4 p = glm::inverse(clip) * glm::dvec4(ndc, z, 1);
    return dvec3(p) / p.w;
  };
  const dvec3 a = at(0.25), b = at(0.75), along = (b.z < a.z ? 1.0 : -1.0) * glm::normalize(b - a);
  const dmat4 worldFromView = glm::inverse(view);
  return {worldFromView * glm::dvec4(a - along * (a.z / along.z), 1), worldFromView * glm::dvec4(along, 0)};
}

// Where a point lies on a slice's row: texels along it, in steps, and aside.
struct OnRow {
  double at = 0, aside = 0;
};
std::optional<OnRow> placeOn(const glm::dvec4& row, const tyndall::ShadowView& view, const dvec3& point) {
  const glm::dvec4 clip = host::fromMat4(view.clipFromWorld) * glm::dvec4(point, 1);
  if (!(clip.w > 0) || std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w) return std::nullopt;
  const dvec2 texel = (0.5 * dvec2(clip) / clip.w + 0.5) * dvec2(kMapWidth, kMapHeight);
  const dvec2 step(row.z, row.w), from = texel - dvec2(row);
  const double at = glm::dot(from, step) / glm::dot(step, step);
  return OnRow{at, glm::length(from - at * step)};
}

struct Missed {
  double aside = 0;  // texels off the row's line
  double beyond = 0; // steps before its first or behind its last one
  double back = 0;   // steps that a farther point lies before a nearer one
  int points = 0;
};

// Points that rays of a slice see, against the row that is to hold them.
Missed missedBy(const SliceTable& table, const Frame& frame, const Light& light, double scale, Random& random) {
  Missed missed;
  const auto count = static_cast<std::size_t>(table.slices);
  for (std::size_t slice = 0; slice < count; ++slice)
    for (int i = 0; i < 20; ++i) {
      const SliceEnds ends = sliceEnds(table, static_cast<int>(slice));
      const WorldRay ray = rayThrough(frame, glm::mix(ends.entry, ends.exit, random.within(0, 1)));
      const double distance = scale * 0.03 * std::pow(1e4, random.within(0, 1));
      for (std::size_t v = 0; v < light.shadow.views.size(); ++v) {
        const glm::dvec4 row(table.texels[(2 + 2 * v) * count + slice]);
        const double texels = table.texels[(3 + 2 * v) * count + slice].x;
        const auto on = placeOn(row, light.shadow.views[v], ray.begin + distance * ray.along);
        if (!on) continue;
        missed.aside = std::max(missed.aside, on->aside);
        missed.beyond = std::max({missed.beyond, -on->at, on->at - texels});
        ++missed.points;
        const auto farther = placeOn(row, light.shadow.views[v], ray.begin + 1.2 * distance * ray.along);
        if (farther) missed.back = std::max(missed.back, on->at - farther->at);
      }
    }
  return missed;
}

std::vector<Light> shadowedLights(const dvec3& eye, const host::ClipConvention& convention, Random& random) {
  std::vector<Light> lights = {sun(random.direction()),
                               sun(random.direction()),
                               spot(eye + random.inCube(9), random.direction(), 0.7),
                               spot(eye + dvec3(0.3, 0.1, -4), {0, 0, 1}, 0.9),  // towards the camera
                               spot(eye + dvec3(0.2, -0.5, 6), {0, 0, -1}, 0.9), // from behind it
                               lamp(eye + random.inCube(9))};
  for (Light& light : lights)
    addViews(light, convention, eye + dvec3(0, 0, -10), 20);
  return lights;
}

} // namespace

TEST_CASE("the row of a slice holds all that its rays see in a shadow map, whatever the scene's place and unit") {
  Random random(31);
  const dvec3 eye(3, -2, 7);
  int points = 0;
  for (const Projection& p : projections())
    for (const double scale : {1e-6, 1.0, 1e6}) {
      Frame frame = frameOf(cameraOf(p, eye, {0.1, -0.2, -1}), 64, 40);
      frame.settings.slices = 30;
      frame.lights = shadowedLights(eye, p.convention, random);
      frame = placed(frame, {turned(random), scale, scale * random.inCube(100)});
      for (std::size_t l = 0; l < frame.lights.size(); ++l)
        for (const int step : {1, 3}) {
          CAPTURE(p.name, scale, l, step);
          frame.settings.rowStep = step;
          const SliceTable table = makeSlices(frame, frame.lights[l], kMapWidth, kMapHeight);
          const Missed missed = missedBy(table, frame, frame.lights[l], scale, random);
          CHECK(missed.aside < 2e-3);
          CHECK(missed.beyond < 2e-3);
          CHECK(missed.back < 2e-3);
          CHECK(isFinite(table));
          points += missed.points;
        }
    }
  CHECK(points > 100000);
}

TEST_CASE("a row steps by whole texels, and is as long as the map at most") {
  Random random(32);
  const dvec3 eye(3, -2, 7);
  for (const Projection& p : projections()) {
    Frame frame = frameOf(cameraOf(p, eye, {0.1, -0.2, -1}), 64, 40);
    frame.settings.slices = 60;
    for (const Light& light : shadowedLights(eye, p.convention, random))
      for (const int step : {1, 2, 8}) {
        frame.settings.rowStep = step;
        const SliceTable table = makeSlices(frame, light, kMapWidth, kMapHeight);
        CAPTURE(p.name, step);
        REQUIRE(table.rows == 2 + 2 * static_cast<int>(light.shadow.views.size()));
        float longest = 0;
        for (int i = 2 * table.slices; i < table.rows * table.slices; ++i) {
          const glm::dvec4 texel(table.texels[static_cast<std::size_t>(i)]);
          if (i / table.slices % 2 == 0) { // origin and step of a row; of one that misses the map, of no length
            const double greater = std::max(std::abs(texel.z), std::abs(texel.w));
            CHECK((greater == Approx(step) || greater == 1));
            continue;
          }
          CHECK(texel.x >= 0);
          CHECK(texel.x <= std::max(kMapWidth, kMapHeight) / step + 1);
          longest = std::max(longest, table.texels[static_cast<std::size_t>(i)].x);
        }
        CHECK(table.longestRow == static_cast<int>(longest));
      }
  }
}

// What lies behind the eye on a slice's plane is never read.
TEST_CASE("a row begins at the eye where all of its rays do") {
  Frame frame = frameOf(cameraOf(projections()[0], {0, 0, 0}, {0, 0, -1}), 64, 40);
  Light light = sun({0, -1, 0});
  light.shadow.texture = 1; // from 10 behind the eye to 30 before it
  light.shadow.views = {
      {host::toMat4(host::orthographic(40, 20, 0, 40, {}) * host::viewLooking({0, 20, -10}, {0, -1, 0}, {0, 0, -1})),
       0}};
  const SliceTable table = makeSlices(frame, light, 800, 400);
  for (int i = 0; i < table.slices; ++i) {
    const float texels = table.texels[static_cast<std::size_t>(3 * table.slices + i)].x;
    CHECK(texels >= 300);
    CHECK(texels <= 302); // a step of rounding, and one begun
  }
}

TEST_CASE("rows of linear depth are coded from 0 at the near plane to all but the last code at the far one") {
  for (const Projection& p : projections()) {
    const Frame frame = frameOf(cameraOf(p, {0, 0, 5}, {0, 0, -1}), 64, 40);
    Light directional = sun({1, -1, 0}), bare = sun({1, -1, 0}), near = spot({1, 2, 3}, {0, -1, 0}, 0.5);
    addViews(directional, p.convention, {0, 0, 0}, 20);
    addViews(near, p.convention, {0, 0, 0}, 20);
    const auto linear = makeSlices(frame, directional, kMapWidth, kMapHeight).block;
    const auto view = tyndall::optics::lightBlock(frame, directional, kMapWidth, kMapHeight).shadowViews[0];
    CAPTURE(p.name);
    CHECK(view.nearDepth * linear.rowCodeScale + linear.rowCodeOffset == Approx(0).margin(1e-7));
    CHECK(view.farDepth * linear.rowCodeScale + linear.rowCodeOffset == Approx(65534.0 / 65535).epsilon(1e-6));
    CHECK(linear.emptyRowCode == 1);
    CHECK(linear.rowCodeSteps == 65535);
    const auto perspective = makeSlices(frame, near, kMapWidth, kMapHeight).block;
    CHECK(perspective.rowCodeScale == 1);
    CHECK(perspective.rowCodeOffset == 0);
    CHECK(perspective.emptyRowCode > 1e38F);
    CHECK(perspective.rowCodeSteps == 0);
    CHECK(isFinite(makeSlices(frame, bare, 0, 0)));
  }
}

TEST_CASE("colours are stored within the range of half floats, and distances within the codes") {
  const Projection p = projections()[0];
  for (const double unit : {1e-6, 1.0, 1e6}) {
    Frame frame = frameOf(cameraOf(p, {0, 0, 0}, {0, 0, -1}), 64, 40);
    frame.medium.farDistance = 1000;
    frame = placed(frame, {glm::dmat3(1), unit, dvec3(0)});
    const dvec3 extinction = tyndall::optics::extinctionOf(frame.medium);
    const auto block = makeSlices(frame, sun({1, -1, 0}), 0, 0).block;
    const double visible = 40 / std::min({extinction.x, extinction.y, extinction.z});
    const double longest = std::min(1000 * unit, visible);
    CAPTURE(unit);
    for (int c = 0; c < 3; ++c) // by the mean free path, or the longest ray
      CHECK(block.storedScale[c] * std::min(longest, 1 / extinction[c]) == Approx(0.5 * 65504).epsilon(1e-5));
    CHECK(block.leastCoordinate == Approx(std::log2(longest) + 2 - 48).margin(1e-4));
  }
}
