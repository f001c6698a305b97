// Which slices moving objects reach (optics/MovedSlices.h): known answers, and pixels that show a point of an object or
// of its shadow.
#include "optics/MovedSlices.h"

#include "OpticsCases.h"
#include "SliceScenes.h"
#include "optics/Blocks.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace tests;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using tyndall::Frame;
using tyndall::Light;
using tyndall::MovingObject;
using tyndall::optics::lightBlock;
using tyndall::optics::makeSlices;
using tyndall::optics::MovedSlices;
using tyndall::optics::movedSlices;
using tyndall::optics::Range;
using tyndall::optics::SliceTable;

namespace {

constexpr int kWidth = 64, kHeight = 40;

struct Moved {
  SliceTable table;
  MovedSlices ranges;
  std::vector<bool> flags;
  int count() const { return static_cast<int>(std::count(flags.begin(), flags.end(), true)); }
};

Moved movedOf(const Frame& frame, int map = 0) {
  const Light& light = frame.lights[0];
  Moved moved{makeSlices(frame, light, map, map), {}, {}};
  moved.ranges = movedSlices(frame, light, lightBlock(frame, light, map, map), moved.table);
  moved.flags = moved.ranges.moved;
  return moved;
}

dmat4 boxAt(const dvec3& middle, const dvec3& half, Random& random) {
  dmat4 turn(turned(random));
  turn[3] = glm::dvec4(middle, 1);
  return turn * glm::scale(dmat4(1), half);
}

dmat4 boxAt(const dvec3& middle, double half) { return glm::scale(glm::translate(dmat4(1), middle), dvec3(half)); }

MovingObject moving(const dmat4& before, const dmat4& now) { return {host::toMat4(now), host::toMat4(before), {}}; }
MovingObject still(const dmat4& box) { return moving(box, box); }

// Another point of the texel, or of the filter, that a map sees a point in.
dvec3 besideInMap(const Frame& frame, const dvec3& point, int map, Random& random) {
  const Light& light = frame.lights[0];
  const double texels = frame.settings.shadowFilter == tyndall::ShadowFilter::Bilinear ? 1 : 0.5;
  for (const tyndall::ShadowView& view : light.shadow.views) {
    const dmat4 clipFromWorld = host::fromMat4(view.clipFromWorld);
    glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
    if (!(clip.w > 0) || std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w) continue;
    clip.x += clip.w * random.within(-texels, texels) * 2 / map;
    clip.y += clip.w * random.within(-texels, texels) * 2 / map;
    const glm::dvec4 beside = glm::inverse(clipFromWorld) * clip;
    return dvec3(beside) / beside.w;
  }
  return point;
}

// The slices beside a pixel, from which it takes its light, that are not flagged.
int missedAt(const Moved& moved, const dvec2& pixel) {
  const int slices = moved.table.slices, nearest = nearestSlice(moved.table, pixel).slice;
  const bool closed = moved.table.block.slicesClosed != 0;
  int other = -1;
  double distance = 1e300;
  for (const int beside : {nearest - 1, nearest + 1}) {
    if (!closed && (beside < 0 || beside >= slices)) continue;
    const int slice = (beside + slices) % slices;
    const double d = distanceTo(moved.table, slice, pixel);
    if (d < distance) other = slice;
    distance = std::min(distance, d);
  }
  const auto isFlagged = [&moved](int slice) { return slice < 0 || moved.flags[static_cast<std::size_t>(slice)]; };
  return (isFlagged(nearest) ? 0 : 1) + (isFlagged(other) ? 0 : 1);
}

// Points of an object as it was and is, and of its shadows, whose pixels' slices are not flagged.
int missed(const Frame& frame, const Moved& moved, int map, Random& random, int& seen) {
  int count = 0;
  const Light& light = frame.lights[0];
  for (const MovingObject& object : frame.objects)
    for (const tyndall::Mat4* pose : {&object.worldFromObject, &object.lastWorldFromObject})
      for (int i = 0; i < 200; ++i) {
        dvec3 point = host::fromMat4(*pose) * glm::dvec4(random.inCube(1), 1);
        if (i % 2) { // in its shadow
          if (light.shadow.texture) point = besideInMap(frame, point, map, random);
          const dvec3 travel =
              light.kind == tyndall::LightKind::Directional ? vec(light.direction) : point - vec(light.position);
          point += glm::normalize(travel) * random.within(0, 40);
        }
        const Seen at = seenAt(frame, point);
        if (!(at.w > 0) || glm::any(glm::lessThan(at.window, dvec2(0))) ||
            glm::any(glm::greaterThan(at.window, dvec2(kWidth, kHeight))))
          continue;
        ++seen;
        // No pixel's centre lies nearer to the image's border than half a pixel, and an epipole may.
        const dvec2 within = glm::clamp(at.window, dvec2(0.5), dvec2(kWidth, kHeight) - 0.5);
        count += missedAt(moved, i % 2 ? within : glm::floor(at.window) + 0.5);
      }
  return count;
}

glm::dvec4 texelOf(const SliceTable& table, int slice, int row) {
  return table
      .texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(table.slices) + static_cast<std::size_t>(slice)];
}

// 1 if a number that a table has is not in a range.
int missedAt(const Range& range, double at, double count) {
  if (!(at >= 0 && at < count)) return 0;
  return at >= range.begin && at < range.end ? 0 : 1;
}

// Of moved slices: samples beside a pixel that shows the point, and texels of rows beside where maps show it, that are
// not in the ranges.
int outOfRanges(const Frame& frame, const Moved& moved, int map, const dvec3& point, int& seen) {
  int count = 0;
  const Seen at = seenAt(frame, point);
  for (int slice = 0; slice < moved.table.slices; ++slice) {
    const glm::dvec4 line = texelOf(moved.table, slice, 1);
    if (!moved.flags[static_cast<std::size_t>(slice)]) continue;
    if (!(at.w > 0) || distanceTo(moved.table, slice, at.window) > 1) continue;
    const double number = glm::dot(dvec2(line), at.window) + line.z;
    for (const double sample : {std::floor(number), std::ceil(number)})
      count += missedAt(moved.ranges.samples[static_cast<std::size_t>(slice)], sample, line.w + 1);
    ++seen;
  }
  const Light& light = frame.lights[0];
  for (std::size_t v = 0; light.shadow.texture != 0 && v < light.shadow.views.size(); ++v) {
    const glm::dvec4 clip = host::fromMat4(light.shadow.views[v].clipFromWorld) * glm::dvec4(point, 1);
    if (!(clip.w > 0) || std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w) continue;
    const dvec2 texel = (0.5 * dvec2(clip) / clip.w + 0.5) * static_cast<double>(map);
    for (int slice = 0; slice < moved.table.slices; ++slice) {
      const glm::dvec4 row = texelOf(moved.table, slice, 2 + 2 * static_cast<int>(v));
      const dvec2 step(row.z, row.w), from = texel - dvec2(row);
      if (!moved.flags[static_cast<std::size_t>(slice)]) continue;
      if (std::abs(from.x * step.y - from.y * step.x) > 0.5 * glm::length(step)) continue;
      const double texels = texelOf(moved.table, slice, 3 + 2 * static_cast<int>(v)).x;
      count += missedAt(
          moved.ranges.texels[v * static_cast<std::size_t>(moved.table.slices) + static_cast<std::size_t>(slice)],
          std::floor(glm::dot(from, step) / glm::dot(step, step)), texels);
      ++seen;
    }
  }
  return count;
}

// Numbers in ranges, over those of all slices: of the samples, row 1 of the table, or of the texels, every second from
// 3 on.
double shareOf(const std::vector<Range>& ranges, const Moved& moved, int row) {
  double in = 0, all = 0;
  for (const Range& range : ranges)
    in += std::max(range.end - range.begin, 0);
  for (int end = row == 1 ? 2 : moved.table.rows; row < end; row += 2)
    for (int slice = 0; slice < moved.table.slices; ++slice) {
      const glm::dvec4 texel = texelOf(moved.table, slice, row);
      all += row == 1 ? texel.w + 1 : 16 * std::ceil(std::max(texel.x, 1.0) / 16);
    }
  return in / std::max(all, 1.0);
}

// Looks along -z from the origin, 90 degrees wide and high; one slice for each pixel of the border.
Frame plainFrame(const Light& light) {
  Projection p;
  p.clipFromView = host::perspective(1, 1, 0.1, 100, {});
  Frame frame = frameOf(cameraOf(p, {0, 0, 0}, {0, 0, -1}), kWidth, kHeight);
  frame.lights = {light};
  frame.settings.slices = 8192;
  return frame;
}

} // namespace

TEST_CASE("no objects move no slices") { CHECK(movedOf(plainFrame(sun({0, -1, 0}))).count() == 0); }

TEST_CASE("an object around the eye, the light or the line between them reaches every slice") {
  Frame frame = plainFrame(lamp({0, 0, -10}));
  for (const dvec3& middle : {dvec3(0, 0, 0), dvec3(0, 0, -10), dvec3(0, 0, -5), dvec3(0, 0, -40)}) {
    frame.objects = {still(boxAt(middle, 0.5))};
    const Moved moved = movedOf(frame);
    CHECK(moved.count() == moved.table.slices);
  }
  frame.objects = {moving(boxAt({-3, 0, -5}, 0.5), boxAt({3, 0, -5}, 0.5))}; // it went through that line
  CHECK(movedOf(frame).count() == movedOf(frame).table.slices);
}

TEST_CASE("an object's slices are as many as its angle around the line from eye to light asks for") {
  Frame frame = plainFrame(sun({0, 0, 1}));
  for (const dvec3& middle : {dvec3(0, -7, -9), dvec3(7, 0, -9), dvec3(0, 7, -9), dvec3(-7, 0, -9)}) {
    frame.objects = {still(boxAt(middle, 1))};
    const Moved moved = movedOf(frame);
    const dvec2 epipole(0.5 * kWidth, 0.5 * kHeight);
    int within = 0, beyond = 0;
    for (int i = 0; i < moved.table.slices; ++i) {
      const dvec2 away = (sliceEnds(moved.table, i).exit - epipole) / dvec2(kWidth, kHeight); // its plane's direction
      const double angle = std::acos(glm::dot(glm::normalize(away), glm::normalize(dvec2(middle))));
      const bool flag = moved.flags[static_cast<std::size_t>(i)];
      within += angle < std::atan(1.0 / 6) && !flag ? 1 : 0;
      beyond += angle > std::atan(2.2 / 4.8) + 0.06 && flag ? 1 : 0; // wider by pixels at its corners, and a slice
    }
    CAPTURE(middle.x, middle.y, moved.count());
    CHECK(within == 0);
    CHECK(beyond == 0);
    CHECK(moved.count() < moved.table.slices / 4);
  }
}

TEST_CASE("a light at the eye, and two slices, are moved by any object") {
  Frame frame = plainFrame(lamp({0, 0, 0}));
  frame.objects = {still(boxAt({9, 0, -9}, 0.1))};
  CHECK(movedOf(frame).count() == movedOf(frame).table.slices);
  frame.objects.clear();
  CHECK(movedOf(frame).count() == 0);
  frame = plainFrame(sun({0, -1, 0}));
  frame.settings.slices = 2;
  frame.objects = {still(boxAt({9, 0, -9}, 0.1))};
  CHECK(movedOf(frame).count() == 2);
}

TEST_CASE("every pixel that shows an object or its shadow belongs to a moved slice; most others do not") {
  Random random(71);
  int seen = 0, numbered = 0;
  double share = 0, samples = 0, texels = 0;
  int frames = 0, mapped = 0;
  for (const Projection& p : projections())
    for (int kind = 0; kind < 3; ++kind)
      for (int i = 0; i < 12; ++i) {
        const dvec3 eye(3, -2, 7);
        Frame frame = frameOf(cameraOf(p, eye, {0.1, -0.2, -1}), kWidth, kHeight);
        frame.settings.slices = i % 3 ? 8192 : 40;
        frame.settings.shadowFilter = i % 2 ? tyndall::ShadowFilter::Bilinear : tyndall::ShadowFilter::Nearest;
        Light light = kind == 0   ? sun(random.direction())
                      : kind == 1 ? lamp(eye + random.inCube(15))
                                  : spot(eye + random.inCube(15), random.direction(), 0.7);
        if (i % 4) addViews(light, p.convention, eye, 30);
        frame.lights = {light};
        const dvec3 middle = eye + dvec3(0, 0, -9) + random.inCube(7), half = dvec3(0.1) + glm::abs(random.inCube(0.6));
        frame.objects = {moving(boxAt(middle, half, random), boxAt(middle + random.inCube(0.5), half, random))};
        const double scale = i % 3 == 0 ? 1e-6 : i % 3 == 1 ? 1 : 1e6;
        const Frame one = placed(frame, {turned(random), scale, scale * random.inCube(20)});
        const int map = i % 4 == 0 ? 0 : i % 4 == 1 ? 8 : 1024;
        const Moved moved = movedOf(frame, map), same = movedOf(one, map);
        CAPTURE(p.name, kind, i);
        CHECK(missed(frame, moved, map, random, seen) == 0);
        CHECK(std::abs(same.count() - moved.count()) <= 2); // rounding of a slice's edge, on either side
        share += static_cast<double>(moved.count()) / moved.table.slices;
        ++frames;
        for (const tyndall::Mat4* pose : {&frame.objects[0].worldFromObject, &frame.objects[0].lastWorldFromObject})
          for (int k = 0; k < 20; ++k)
            CHECK(outOfRanges(frame, moved, map, host::fromMat4(*pose) * glm::dvec4(random.inCube(1), 1), numbered) ==
                  0);
        samples += shareOf(moved.ranges.samples, moved, 1);
        if (map < 1024 || light.shadow.texture == 0) continue;
        texels += shareOf(moved.ranges.texels, moved, 3);
        ++mapped;
      }
  CHECK(seen > 20000);
  CHECK(numbered > 20000);
  CHECK(share < 0.45 * frames);
  CHECK(samples < 0.3 * frames);
  CHECK(texels < 0.3 * mapped);
}
