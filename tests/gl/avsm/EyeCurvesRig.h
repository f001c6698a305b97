// Smoke before the eye of a rig (Frame::eyeCurves), and scenes to see behind it.
#pragma once

#include "../effect/MediaRig.h"
#include "AvsmRig.h"
#include "reference/Metrics.h"
#include "support/Catch.h"

namespace tests::eye {

using namespace tyndall;

inline constexpr int kSize = 48; // of the map
inline constexpr double kNear = 0.5, kFar = 12;
inline constexpr LightKind kKinds[] = {LightKind::Directional, LightKind::Point, LightKind::Spot};

// Balls before the eye, the first of which lets nothing through unless all is soft.
inline std::vector<Captured> puffs(unsigned seed, bool solid = true) {
  Puffs balls;
  balls.size = kSize;
  balls.count = 12;
  balls.radius = {0.15F, 0.2F};
  balls.depth = {0.05F, 0.6F};
  balls.thickness = {0.03F, 0.12F};
  balls.density = 12;
  balls.solid = solid;
  return segmentsOf(balls, seed);
}

// What stands before the eye of a rig.
struct Smoke {
  AvsmRig map;

  explicit Smoke(bool packed = false, int nodes = 8) : map(config(packed, nodes)) {}

  static AvsmConfig config(bool packed, int nodes = 8) {
    AvsmConfig made;
    made.size = kSize;
    made.packed = packed;
    made.nodes = nodes;
    return made;
  }

  void enter(SceneRig& rig, const std::vector<Captured>& segments) {
    for (int i = 0; i < 2; ++i) // the memory grows
      map.capture(segments);
    REQUIRE(map.avsm().statistics().lost == 0);
    rig.frame.eyeCurves = {map.avsm().curves(), kNear, kFar};
    rig.eyeCurves = map.map();
  }
};

inline SceneRig sceneOf(LightKind kind, bool glass) {
  SceneRig rig(24, 16);
  rig.addLight(kind, Casters::Blocks, glass);
  rig.frame.medium = media::haze();
  return rig;
}

inline double rRmse(const reference::Image& image, const reference::Image& truth) {
  return reference::compare(image, truth).rRmse;
}

} // namespace tests::eye
