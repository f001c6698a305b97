// What a frame and its lights read, but for the content of textures, to be compared with the last frame's.
#pragma once

#include "CheckFrame.h"
#include "SharedBlocks.h"
#include "plan/LightVariant.h"

#include <cstdint>
#include <tyndall/tyndall.h>
#include <vector>

namespace tyndall {

/// Which textures they are, and the version of what they hold: a version belongs to its texture.
struct DepthContent {
  gl::Uint texture = 0;
  int layer = -1, x = 0, y = 0; // where in it the image begins
  std::uint64_t version = 0;
};
struct MapContent {
  gl::Uint shadow = 0, glassColour = 0, glassDepth = 0;
  std::uint64_t version = 0;
};

/// What is added to each pixel by itself: light of the surroundings.
struct AmbientKey {
  blocks::AmbientBlock block{};
  AmbientOcclusion occlusion;
};

/// What light is looked up in, and which write of those textures was the last.
struct LookupKey {
  Lookup engines;
  FrameTextures::Lookup textures;
  std::uint64_t write = 0;
};

DepthContent depthOf(const Frame& frame);
MapContent mapsOf(const Light& light);

/// True if the same textures are stated to hold the same.
bool isStated(const DepthContent& now, const DepthContent& last);
bool isStated(const MapContent& now, const MapContent& last);

struct LightKey {
  blocks::LightBlock block{};
  Settings settings;
  FrameTextures::Shadow map;
  LightVariant variant;
  AvsmCurves curves;
  std::vector<blocks::CopyBlock> copies = {}; ///< of the maps
};

struct FrameKey {
  blocks::FrameBlock block{}; ///< but for the jitter
  glm::vec2 jitter{0};
  AmbientKey ambient;
  LookupKey lookup;
  AvsmCurves eyeCurves;
  double slicesBeyond = 0; ///< pixels beyond the image
  Settings settings;
  std::vector<std::size_t> drawn; ///< indices of the lights
  std::vector<LightKey> lights;   ///< of those
};

bool same(const LightKey& a, const LightKey& b);
/// True if maps are copied in the same way, or not.
bool sameCopies(const LightKey& a, const LightKey& b);
bool same(const AmbientKey& a, const AmbientKey& b);
bool same(const LookupKey& a, const LookupKey& b);
/// But for the lights' own, the surroundings' and the jitter.
bool sameFrame(const FrameKey& a, const FrameKey& b);

} // namespace tyndall
