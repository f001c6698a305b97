// What the tests of temporal reuse share: a scene in which a box tumbles, and its frames with what they reuse and in
// full.
#pragma once

#include "ShaftRig.h"
#include "support/Catch.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace tests::reuse {

using namespace tyndall;

inline std::uint64_t newView() { // the effect is the tests' own: no test meets another's history
  static std::uint64_t count = 100;
  return ++count;
}

inline Light lamp(LightKind kind, const Vec3& position, const Vec3& direction) {
  Light light = tests::shaftLight(kind);
  light.position = position;
  light.direction = direction;
  return light;
}

inline Light sun() { return tests::shaftLight(LightKind::Directional); }
inline Light spot() { return lamp(LightKind::Spot, {-0.6, 9.4, -7}, {0.1, -1, -0.3}); }
inline Light point() { return lamp(LightKind::Point, {-0.6, 8.5, -3.5}, {0, -1, 0}); }

// A small box that tumbles across the scene.
inline glm::dmat4 tumbling(int frame) {
  const double t = 0.21 * frame;
  const glm::dvec3 place(1.5 * std::sin(t) + 0.4, 1.4 + 0.5 * std::cos(1.7 * t), -4.5 - std::cos(t));
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), place);
  return glm::scale(glm::rotate(moved, 1.3 * t, glm::normalize(glm::dvec3(1, 2, 3))), glm::dvec3(0.3, 0.12, 0.2));
}

inline MovingObject between(const glm::dmat4& last, const glm::dmat4& now) {
  return {tests::toMat4(now), tests::toMat4(last)};
}

struct Picture {
  reference::ImageAnswer answer;
  double share = 0;
};

// The frame with what it reuses.
inline Picture reused(tests::ShaftRig& rig) {
  Picture picture;
  picture.answer = rig.scene.render();
  picture.share = tests::testEffect().statistics().redrawnShare;
  return picture;
}

// The same frame in full; leaves the history alone.
inline reference::ImageAnswer full(tests::ShaftRig& rig) {
  const Reuse reuse = rig.scene.frame.reuse;
  const std::vector<MovingObject> objects = rig.scene.frame.objects;
  rig.scene.frame.reuse = {};
  rig.scene.frame.objects.clear();
  reference::ImageAnswer answer = rig.scene.render();
  rig.scene.frame.reuse = reuse;
  rig.scene.frame.objects = objects;
  return answer;
}

inline void checkSame(const Picture& picture, const reference::ImageAnswer& expected) {
  CHECK(tests::difference(picture.answer.inscatter, expected.inscatter) <= 1e-5);
  CHECK(tests::difference(picture.answer.transmittance, expected.transmittance) <= 1e-5);
}

// What a box does in a frame after the first: objects, depth and maps.
inline void moveTo(tests::ShaftRig& rig, int frame) {
  Frame& f = rig.scene.frame;
  rig.setMoving({tumbling(frame)});
  ++f.reuse.frame;
  f.objects.clear();
  if (f.reuse.changes == Changes::Objects && frame > 0) f.objects = {between(tumbling(frame - 1), tumbling(frame))};
}

inline void begin(tests::ShaftRig& rig, Changes changes) {
  rig.scene.frame.settings.technique = Technique::Epipolar;
  rig.scene.frame.reuse.changes = changes;
  rig.scene.frame.reuse.eye = newView();
}

// A small frame of a sun whose maps' versions stay as they are.
inline tests::ShaftRig sunlit(Changes changes) {
  tests::ShaftRig rig(64, 48);
  rig.addLight(sun(), 64);
  rig.scene.frame.lights[0].shadow.version = 7;
  rig.scene.frame.depth.version = 3;
  begin(rig, changes);
  return rig;
}

} // namespace tests::reuse
