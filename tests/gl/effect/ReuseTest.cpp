// Temporal reuse (Frame::reuse): whatever moves, a reused frame is the frame in full, and work is saved.
#include "ShaftRig.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <gl/ReadBack.h>
#include <glm/gtc/matrix_transform.hpp>

using namespace tyndall;

namespace {

std::uint64_t newView() { // the effect is the tests' own: no test meets another's history
  static std::uint64_t count = 100;
  return ++count;
}

Light lamp(LightKind kind, const Vec3& position, const Vec3& direction) {
  Light light = tests::shaftLight(kind);
  light.position = position;
  light.direction = direction;
  return light;
}

Light sun() { return tests::shaftLight(LightKind::Directional); }
Light spot() { return lamp(LightKind::Spot, {-0.6, 9.4, -7}, {0.1, -1, -0.3}); }
Light point() { return lamp(LightKind::Point, {-0.6, 8.5, -3.5}, {0, -1, 0}); }

// A small box that tumbles across the scene.
glm::dmat4 tumbling(int frame) {
  const double t = 0.21 * frame;
  const glm::dvec3 place(1.5 * std::sin(t) + 0.4, 1.4 + 0.5 * std::cos(1.7 * t), -4.5 - std::cos(t));
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), place);
  return glm::scale(glm::rotate(moved, 1.3 * t, glm::normalize(glm::dvec3(1, 2, 3))), glm::dvec3(0.3, 0.12, 0.2));
}

MovingObject between(const glm::dmat4& last, const glm::dmat4& now) {
  return {tests::toMat4(now), tests::toMat4(last)};
}

struct Picture {
  reference::ImageAnswer answer;
  double share = 0;
};

// The frame with what it reuses.
Picture reused(tests::ShaftRig& rig) {
  Picture picture;
  picture.answer = rig.scene.render();
  picture.share = tests::testEffect().statistics().redrawnShare;
  return picture;
}

// The same frame in full; leaves the history alone.
reference::ImageAnswer full(tests::ShaftRig& rig) {
  const Reuse reuse = rig.scene.frame.reuse;
  const std::vector<MovingObject> objects = rig.scene.frame.objects;
  rig.scene.frame.reuse = {};
  rig.scene.frame.objects.clear();
  reference::ImageAnswer answer = rig.scene.render();
  rig.scene.frame.reuse = reuse;
  rig.scene.frame.objects = objects;
  return answer;
}

void checkSame(const Picture& picture, const reference::ImageAnswer& expected) {
  CHECK(tests::difference(picture.answer.inscatter, expected.inscatter) <= 1e-5);
  CHECK(tests::difference(picture.answer.transmittance, expected.transmittance) <= 1e-5);
}

// What a box does in a frame after the first: objects, depth and maps.
void moveTo(tests::ShaftRig& rig, int frame) {
  Frame& f = rig.scene.frame;
  rig.setMoving({tumbling(frame)});
  ++f.reuse.frame;
  f.objects.clear();
  if (f.reuse.changes == Changes::Objects && frame > 0) f.objects = {between(tumbling(frame - 1), tumbling(frame))};
}

void begin(tests::ShaftRig& rig, Changes changes) {
  rig.scene.frame.settings.technique = Technique::Epipolar;
  rig.scene.frame.reuse.changes = changes;
  rig.scene.frame.reuse.view = newView();
}

} // namespace

TEST_CASE("reused frames are the frames in full, by every light, filter and way to tell what moved") {
  struct Case {
    Light light;
    bool glass;
    ShadowFilter filter;
    int cascades;
  };
  const auto nearest = ShadowFilter::Nearest, bilinear = ShadowFilter::Bilinear;
  for (const Case& item :
       {Case{sun(), false, nearest, 1}, Case{sun(), true, nearest, 1}, Case{sun(), true, bilinear, 1},
        Case{sun(), false, bilinear, 3}, Case{spot(), false, nearest, 1}, Case{spot(), true, bilinear, 1},
        Case{point(), false, nearest, 1}})
    for (const Changes changes : {Changes::Detect, Changes::Objects}) {
      CAPTURE(static_cast<int>(item.light.kind), item.glass, static_cast<int>(item.filter), item.cascades,
              static_cast<int>(changes));
      tests::ShaftRig rig(96, 64);
      Light light = item.light;
      if (item.cascades > 1) light.shadow.views = tests::shadowViews(light, item.cascades);
      rig.addLight(light, 128, item.glass);
      rig.scene.frame.settings.shadowFilter = item.filter;
      begin(rig, changes);
      int parts = 0;
      for (int frame = 0; frame < 8; ++frame) {
        CAPTURE(frame);
        moveTo(rig, frame);
        const Picture picture = reused(rig);
        checkSame(picture, full(rig));
        if (picture.share > 0 && picture.share < 1) ++parts;
      }
      CHECK(parts == 7);
    }
}

namespace {

// A slab with one face in a plane through the eye and the sun overhead: all of its edge is seen, and casts, in one
// slice.
glm::dmat4 radial(int frame) {
  const glm::dmat4 eye = glm::translate(glm::dmat4(1), glm::dvec3(0, 2, 0));
  const glm::dmat4 turned = glm::rotate(eye, 0.45 - 0.0137 * frame, glm::dvec3(0, 1, 0));
  return glm::scale(glm::translate(turned, glm::dvec3(0.2, 0.3, -4.5)), glm::dvec3(0.2, 0.5, 0.05));
}

Light sunOverhead() {
  Light light = sun();
  light.direction = {0, -1, 1e-3};
  const glm::dmat4 view = glm::lookAt(glm::dvec3(0, 30, 0), glm::dvec3(0, 0, 0.03), glm::dvec3(0, 0, 1));
  light.shadow.views = {{tests::toMat4(glm::ortho(-8.0, 8.0, -8.0, 8.0, 1.0, 60.0) * view), 0}};
  return light;
}

// What View::Redrawn shows of the frame, which is drawn: true for red.
std::vector<bool> maskOf(tests::ShaftRig& rig) {
  Frame& frame = rig.scene.frame;
  const auto pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  const host::GlTexture colour = rig.scene.makeColour(GL_RGBA32F, std::vector<float>(4 * pixels, 0.25F));
  frame.settings.view = View::Redrawn;
  rig.scene.render();
  const std::vector<float> rgba = host::readColour(colour.name(), frame.width, frame.height);
  frame.settings.view = View::Composite;
  frame.colour = 0;
  std::vector<bool> mask;
  for (std::size_t i = 0; i < pixels; ++i)
    mask.push_back(rgba[4 * i] > 0.5F);
  return mask;
}

// Without the pixels whose neighbourhood of some pixels is not all set.
std::vector<bool> shrunk(const std::vector<bool>& mask, int width, int height, int by) {
  std::vector<bool> result = mask;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int dx = -by; dx <= by; ++dx) {
        const int at = std::clamp(x + dx, 0, width - 1);
        if (!mask[static_cast<std::size_t>(y * width + at)]) result[static_cast<std::size_t>(y * width + x)] = false;
      }
  return result;
}

bool covers(const std::vector<bool>& mask, const reference::Image& a, const reference::Image& b) {
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y) && !mask[static_cast<std::size_t>(y * a.width + x)]) return false;
  return true;
}

} // namespace

TEST_CASE("the mask holds every pixel that changes, and without the pixels along its border it does not") {
  for (const Changes changes : {Changes::Detect, Changes::Objects})
    for (const ShadowFilter filter : {ShadowFilter::Nearest, ShadowFilter::Bilinear}) {
      CAPTURE(static_cast<int>(changes), static_cast<int>(filter));
      tests::ShaftRig rig(96, 64);
      rig.addLight(sunOverhead(), 512);
      rig.scene.frame.settings.shadowFilter = filter;
      rig.scene.frame.settings.technique = Technique::Epipolar;
      begin(rig, changes);
      reference::Image last;
      bool tight = false;
      for (int frame = 0; frame < 16; ++frame) {
        CAPTURE(frame);
        rig.setMoving({radial(frame)});
        ++rig.scene.frame.reuse.frame;
        rig.scene.frame.objects.clear();
        if (changes == Changes::Objects && frame > 0)
          rig.scene.frame.objects = {between(radial(frame - 1), radial(frame))};
        const std::vector<bool> mask = maskOf(rig);
        const reference::Image now = full(rig).inscatter;
        if (frame == 0) CHECK(std::count(mask.begin(), mask.end(), true) == 96 * 64);
        if (frame > 0) {
          CHECK(covers(mask, now, last));
          // Boxes are widened by what a sample may see, and by a slice.
          tight = tight || !covers(shrunk(mask, 96, 64, changes == Changes::Detect ? 17 : 17), now, last);
        }
        last = now;
      }
      CHECK(tight);
    }
}
