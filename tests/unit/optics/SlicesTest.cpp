// Where slices run in the image (optics/Slices.h): known answers, and every pixel against every slice.
#include "optics/Slices.h"

#include "OpticsCases.h"
#include "SliceScenes.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>

using namespace tests;
using glm::dvec2;
using glm::dvec3;
using tyndall::Frame;
using tyndall::Light;
using tyndall::optics::makeSlices;
using tyndall::optics::SliceTable;

namespace {

constexpr int kWidth = 33, kHeight = 20;

// Looks along -z from the origin: x and y of a window position are 16.5 (1 - x / z) and 10 (1 - y / z).
Frame squareFrame() {
  Projection p;
  p.clipFromView = host::perspective(1, 1, 0.1, 100, {});
  return frameOf(cameraOf(p, {0, 0, 0}, {0, 0, -1}), kWidth, kHeight);
}

// The light's place in that frame's image.
Light lampAt(const dvec2& window, double distance = 5) {
  return lamp(distance * dvec3(window.x / (0.5 * kWidth) - 1, window.y / (0.5 * kHeight) - 1, -1));
}

SliceTable slicesOf(Frame frame, const Light& light, int slices = 8192) {
  frame.settings.slices = slices;
  frame.settings.samples = 64;
  return makeSlices(frame, light, 0, 0);
}

dvec2 entryOf(const SliceTable& table, int i) { return sliceEnds(table, i).entry; }
dvec2 exitOf(const SliceTable& table, int i) { return sliceEnds(table, i).exit; }

bool isOnBorder(const dvec2& p, int width, int height) {
  const dvec2 low = glm::abs(p - 0.5), high = glm::abs(p - dvec2(width, height) + 0.5);
  return std::min(std::min(low.x, low.y), std::min(high.x, high.y)) < 1e-3;
}

// Lights that put the epipole in and out of the image, behind the camera, at infinity and at the eye.
std::vector<Light> lightsAround(double scale, const dvec3& eye, unsigned seed) {
  Random random(seed);
  std::vector<Light> lights;
  for (int i = 0; i < 6; ++i) {
    lights.push_back(sun(random.direction()));
    lights.push_back(lamp(eye + scale * random.inCube(10)));
  }
  lights.push_back(lamp(eye));
  lights.push_back(lamp(eye + scale * 1e12 * random.direction()));
  for (const dvec3& axis : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)})
    for (const double side : {-1.0, 1.0})
      lights.push_back(sun(side * axis));
  return lights;
}

} // namespace

TEST_CASE("slices leave an epipole in the image in all directions, evenly spaced along the border") {
  for (const double side : {-1.0, 1.0}) { // a sun ahead, and one behind the camera: the same lines
    const SliceTable table = slicesOf(squareFrame(), sun({0, 0, side}));
    CHECK(table.slices == 2 * (kWidth - 1 + kHeight - 1));
    CHECK(table.block.slicesClosed == 1);
    CHECK(table.block.epipoleSign == (side > 0 ? 1 : -1));
    CHECK(table.block.sliceWidth == Approx(1));
    const dvec2 centre(0.5 * kWidth, 0.5 * kHeight);
    for (int i = 0; i < table.slices; ++i) {
      const dvec2 entry = entryOf(table, i), exit = exitOf(table, i), next = exitOf(table, (i + 1) % table.slices);
      CHECK(isOnBorder(exit, kWidth, kHeight));
      CHECK(glm::distance(entry, centre) == Approx(EPIPOLE_GAP).margin(1e-5));
      CHECK(std::abs(exit.x - next.x) + std::abs(exit.y - next.y) == Approx(1).margin(1e-4));
    }
  }
}

TEST_CASE("light across the view makes parallel slices, from where it comes to where it goes") {
  const SliceTable table = slicesOf(squareFrame(), sun({0, -2, 0}));
  CHECK(table.slices == kWidth - 1);
  CHECK(table.block.slicesClosed == 0);
  CHECK(table.block.epipole.z == 0);
  for (int i = 0; i < table.slices; ++i) {
    CHECK(exitOf(table, i).x == Approx(i + 1.0).margin(1e-4)); // halfway between pixels: one slice for each gap
    CHECK(exitOf(table, i).y == Approx(0.5));
    CHECK(entryOf(table, i).x == Approx(exitOf(table, i).x).margin(1e-4));
    CHECK(entryOf(table, i).y == Approx(kHeight - 0.5));
  }
}

TEST_CASE("an epipole outside of the image is left through the sides that it sees from behind") {
  const double width = kWidth - 1, height = kHeight - 1;
  struct Case {
    dvec2 epipole;
    double visible, begin;
  };
  // Left of the image, beyond the low corner, in the corner itself, on the right border, above.
  const Case cases[] = {{{-9, 10}, 2 * width + height, 0},
                        {{-9, -9}, width + height, width},
                        {{0.5, 0.5}, width + height, width},
                        {{kWidth - 0.5, 10}, 2 * width + height, width + height},
                        {{16.5, 29}, width + 2 * height, 2 * width + height}};
  for (const Case& c : cases) {
    CAPTURE(c.epipole.x, c.epipole.y);
    const SliceTable table = slicesOf(squareFrame(), lampAt(c.epipole));
    CHECK(table.slices == c.visible);
    CHECK(table.block.slicesClosed == 0);
    CHECK(table.block.slicesBegin == Approx(c.begin).margin(1e-3));
    CHECK(table.block.borderLength == Approx(2 * (width + height)));
    const dvec3 epipole(table.block.epipole);
    CHECK(epipole.x / epipole.z == Approx(c.epipole.x).margin(1e-4));
    CHECK(epipole.y / epipole.z == Approx(c.epipole.y).margin(1e-4));
  }
}

TEST_CASE("every pixel lies within half a slice of one, whatever the camera and wherever the light") {
  const dvec3 eye(3, -2, 7);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Projection& p : projections(scale)) {
      const Frame frame = frameOf(cameraOf(p, scale * eye, {0.4, -0.2, -1}), kWidth, kHeight);
      unsigned number = 0;
      for (const Light& light : lightsAround(scale, scale * eye, 11)) {
        const SliceTable table = slicesOf(frame, light, number % 2 ? 8192 : 24);
        CAPTURE(p.name, scale, number++);
        double farthest = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            farthest = std::max(farthest, nearestSlice(table, {x + 0.5, y + 0.5}).distance);
        CHECK(farthest < 0.5 * static_cast<double>(table.block.sliceWidth) + EPIPOLE_GAP + 1e-3);
      }
    }
}

TEST_CASE("a slice lies on a line through the light's place, away from it, and ends on the border") {
  const dvec3 eye(3, -2, 7);
  for (const Projection& p : projections()) {
    const Frame frame = frameOf(cameraOf(p, eye, {0.4, -0.2, -1}), kWidth, kHeight);
    unsigned number = 0;
    for (const Light& light : lightsAround(1, eye, 12)) {
      CAPTURE(p.name, number++);
      const SliceTable table = slicesOf(frame, light, 40);
      const dvec3 epipole(table.block.epipole);
      for (int i = 0; i < table.slices; ++i) {
        const dvec2 entry = entryOf(table, i), exit = exitOf(table, i);
        const dvec2 away = (epipole.z < 0 ? -1.0 : 1.0) * (epipole.z * exit - dvec2(epipole));
        const dvec2 along = exit - entry;
        CHECK(std::abs(along.x * away.y - along.y * away.x) <= 1e-4 * glm::length(away) * (1 + glm::length(along)));
        CHECK(glm::dot(along, away) >= 0);
        CHECK(isOnBorder(exit, kWidth, kHeight));
        CHECK(glm::all(glm::greaterThanEqual(entry, dvec2(0.5))));
        CHECK(glm::all(glm::lessThanEqual(entry, dvec2(kWidth, kHeight) - 0.5)));
      }
    }
  }
}

// As lib/slices.glsl reads it.
TEST_CASE("the block says where along the border each slice leaves") {
  for (const dvec2& epipole : {dvec2(16, 9), dvec2(-9, 10), dvec2(-9, -9), dvec2(50, 10), dvec2(16, 90)})
    for (const int slices : {7, 8192}) {
      const SliceTable table = slicesOf(squareFrame(), lampAt(epipole), slices);
      CAPTURE(epipole.x, epipole.y, slices);
      const dvec2 size(kWidth - 1, kHeight - 1);
      for (int i = 0; i < table.slices; ++i) {
        const dvec2 at = exitOf(table, i) - 0.5;
        double arc = at.x; // bottom
        if (at.y > 1e-4) arc = size.x + at.y;
        if (at.y > size.y - 1e-4) arc = 2 * size.x + size.y - at.x;
        if (at.x < 1e-4) arc = 2 * size.x + 2 * size.y - at.y;
        if (at.x > size.x - 1e-4) arc = size.x + at.y;
        const double said =
            static_cast<double>(table.block.slicesBegin) + (i + 0.5) * static_cast<double>(table.block.sliceWidth);
        CHECK(std::abs(std::remainder(arc - said, 2 * (size.x + size.y))) < 2e-3);
      }
    }
}

TEST_CASE("samples are numbered along a slice, no denser than pixels nor more than wanted") {
  for (const int samples : {64, 8192}) {
    Frame frame = squareFrame();
    frame.settings.samples = samples;
    frame.viewport.width *= 8;
    frame.viewport.height *= 8;
    const SliceTable table = makeSlices(frame, lampAt({20, 4}), 0, 0);
    std::uint64_t regular = 0;
    for (int i = 0; i < table.slices; ++i) {
      const glm::dvec4 numbers(table.texels[static_cast<std::size_t>(table.slices + i)]);
      const dvec2 entry = entryOf(table, i), exit = exitOf(table, i);
      const double length = glm::distance(entry, exit);
      CHECK(numbers.w + 1 == Approx(std::min<double>(samples, std::ceil(length - 1e-4) + 1)).margin(1.001));
      CHECK(numbers.w <= length + 1.001);
      CHECK(numbers.w + 1 <= samples);
      for (const double share : {0.0, 0.5, 1.0})
        CHECK(glm::dot(dvec2(numbers), glm::mix(entry, exit, share)) + numbers.z ==
              Approx(share * numbers.w).margin(1e-2));
      regular += (static_cast<std::uint64_t>(numbers.w) + 16) / 16;
    }
    CHECK(table.regularSamples == regular);
  }
}

TEST_CASE("turning or moving the world, or its unit, moves no slice; a mirror mirrors them") {
  Random random(21);
  for (const Projection& p : projections()) {
    Frame frame = frameOf(cameraOf(p, {1, 2, 3}, {0.4, -0.2, -1}), kWidth, kHeight);
    frame.lights = {sun(random.direction()), lamp(dvec3(1, 2, 3) + random.inCube(8)), lamp({6, 1, -9})};
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Frame other = placed(frame, {turned(random), scale, scale * random.inCube(20)});
      for (std::size_t l = 0; l < frame.lights.size(); ++l) {
        CAPTURE(p.name, scale, l);
        const SliceTable table = slicesOf(frame, frame.lights[l]), same = slicesOf(other, other.lights[l]);
        REQUIRE(same.slices == table.slices);
        for (int i = 0; i < table.slices; ++i) {
          CHECK(glm::distance(exitOf(table, i), exitOf(same, i)) < 1e-3);
          CHECK(glm::distance(entryOf(table, i), entryOf(same, i)) < 1e-3);
        }
      }
    }
    Frame mirrored = frame;
    glm::dmat4 mirror(1);
    mirror[0][0] = -1;
    mirrored.camera.clipFromView = host::toMat4(mirror * p.clipFromView);
    for (std::size_t l = 0; l < frame.lights.size(); ++l) {
      CAPTURE(p.name, l);
      const SliceTable table = slicesOf(frame, frame.lights[l]), other = slicesOf(mirrored, frame.lights[l]);
      REQUIRE(other.slices == table.slices);
      for (int i = 0; i < other.slices; ++i) {
        const dvec2 exit = exitOf(other, i), entry = entryOf(other, i);
        double nearest = 1e9;
        for (int k = 0; k < table.slices; ++k)
          nearest = std::min(nearest, glm::distance(exitOf(table, k), {kWidth - exit.x, exit.y}) +
                                          glm::distance(entryOf(table, k), {kWidth - entry.x, entry.y}));
        CHECK(nearest < 2e-3);
      }
    }
  }
}

TEST_CASE("images of one pixel, one row or one column have slices, too") {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2)})
    for (const Light& light : lightsAround(1, {0, 0, 0}, 13)) {
      Frame frame = squareFrame();
      frame.viewport.width = size.x;
      frame.viewport.height = size.y;
      const SliceTable table = slicesOf(frame, light);
      CAPTURE(size.x, size.y);
      CHECK(table.slices >= 1);
      CHECK(static_cast<int>(table.texels.size()) == table.slices * table.rows);
      CHECK(isFinite(table));
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
          CHECK(nearestSlice(table, {x + 0.5, y + 0.5}).distance <
                0.5 * static_cast<double>(table.block.sliceWidth) + EPIPOLE_GAP + 1e-3);
    }
}
