#include "reuse/Keys.h"

#include "optics/EngineDepth.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>

namespace tyndall {

namespace {

// A block has no padding: all of it is what shaders read.
template <typename Block>
std::array<std::uint32_t, sizeof(Block) / 4> wordsOf(const Block& block) {
  std::array<std::uint32_t, sizeof(Block) / 4> words;
  std::memcpy(words.data(), &block, sizeof block);
  return words;
}

template <typename Block>
bool same(const Block& a, const Block& b) {
  return wordsOf(a) == wordsOf(b);
}

auto fieldsOf(const Settings& s) {
  return std::tie(s.technique, s.debugView, s.shadowFilter, s.slices, s.samples, s.rowStep, s.minMaxTree,
                  s.breakThreshold, s.bendThreshold, s.leastWeight, s.averageThreshold, s.spreadThreshold,
                  s.errorTarget, s.lowRankTerms, s.sampleBudget);
}

auto fieldsOf(const LightVariant& v) {
  return std::tie(v.lightKind, v.shadowViews, v.shadowArray, v.bilinear, v.glass, v.layers, v.monochrome, v.composite);
}

bool isStated(std::uint64_t version, std::uint64_t last) { return version != 0 && version == last; }

} // namespace

bool isStated(const DepthContent& now, const DepthContent& last) {
  return now.texture == last.texture && now.layer == last.layer && now.x == last.x && now.y == last.y &&
         isStated(now.version, last.version);
}

bool isStated(const MapContent& now, const MapContent& last) {
  return now.shadow == last.shadow && now.glassColour == last.glassColour && now.glassDepth == last.glassDepth &&
         isStated(now.version, last.version);
}

DepthContent depthOf(const Frame& frame) {
  const Rectangle shown = optics::depthRectangle(frame);
  return {frame.depth.texture, frame.depth.layer, shown.x, shown.y, frame.depth.version};
}

MapContent mapsOf(const Light& light) {
  return {light.shadow.texture, light.glass.colour, light.glass.depth, light.shadow.version};
}

namespace {

bool same(const AvsmCurves& a, const AvsmCurves& b) {
  return a.texture == b.texture && (a.texture == 0 || isStated(a.version, b.version));
}

} // namespace

bool sameCopies(const LightKey& a, const LightKey& b) {
  return std::equal(a.copies.begin(), a.copies.end(), b.copies.begin(), b.copies.end(),
                    [](const blocks::CopyBlock& p, const blocks::CopyBlock& q) { return same(p, q); });
}

bool same(const LightKey& a, const LightKey& b) {
  return same(a.curves, b.curves) && sameCopies(a, b) && same(a.block, b.block) &&
         fieldsOf(a.settings) == fieldsOf(b.settings) && a.map.width == b.map.width && a.map.height == b.map.height &&
         fieldsOf(a.variant) == fieldsOf(b.variant);
}

bool same(const AmbientKey& a, const AmbientKey& b) {
  const AmbientOcclusion &now = a.occlusion, &last = b.occlusion;
  return same(a.block, b.block) && now.texture == last.texture &&
         (now.texture == 0 || isStated(now.version, last.version));
}

bool same(const LookupKey& a, const LookupKey& b) {
  const auto fieldsOf = [](const LookupKey& k) {
    const Lookup& l = k.engines;
    return std::tie(l.inscatter, l.transmittance, l.nearDistance, l.farDistance, k.textures.width, k.textures.height,
                    k.textures.depths, k.write);
  };
  return a.textures.depths == 0 || fieldsOf(a) == fieldsOf(b); // none is wanted
}

bool sameFrame(const FrameKey& a, const FrameKey& b) {
  return same(a.block, b.block) && same(a.eyeCurves, b.eyeCurves) && fieldsOf(a.settings) == fieldsOf(b.settings) &&
         a.drawn == b.drawn && a.slicesBeyond == b.slicesBeyond;
}

} // namespace tyndall
