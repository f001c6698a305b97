#include "plan/MapCopies.h"

#include "optics/Blocks.h"
#include "optics/EyeLight.h"
#include "optics/HeightFog.h"
#include "optics/MapCopy.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

// Several views of one texture are read as they are by all passes but the seldom ones (plan/General.cpp). Where
// something before the eye dims the light no pass reads a texture without layers: rows are made of it first.
bool isSeldomAtlas(const Frame& frame, const Light& light) {
  const Settings& settings = frame.settings;
  if (light.shadow.array) return false;
  const bool filters = settings.shadowFilter == ShadowFilter::Bilinear, glass = light.glass.colour != 0;
  const bool spreads = settings.technique == Technique::Epipolar && std::isfinite(settings.spreadThreshold);
  const bool several = light.shadow.views.size() > 1;
  const bool isExact = settings.technique == Technique::Exact || settings.debugView == DebugView::Difference;
  if (optics::isDimmedBeforeEye(frame)) return several || filters || glass || spreads || isExact;
  const int kinds = (filters ? 1 : 0) + (glass ? 1 : 0) + (light.curves.texture != 0 ? 1 : 0);
  const bool looksUp = settings.technique == Technique::LowRank || settings.debugView == DebugView::NodeVisits;
  return several && (kinds > 1 || spreads || optics::isLayered(frame.medium) || (looksUp && (filters || glass)));
}

// Programs for filtered glass know of no rectangle that begins elsewhere than a layer (glsl/lib/shadowMap.glsl).
bool isSeldomRectangle(const Settings& settings, const Light& light) {
  const std::vector<ShadowView>& views = light.shadow.views;
  return settings.shadowFilter == ShadowFilter::Bilinear && light.glass.colour != 0 &&
         std::any_of(views.begin(), views.end(),
                     [](const ShadowView& view) { return view.rectangle.x != 0 || view.rectangle.y != 0; });
}

bool isCopied(const Frame& frame, const Light& light) {
  const ShadowMap& map = light.shadow;
  return map.cube.enabled || map.encoding != DepthEncoding::Window || isSeldomAtlas(frame, light) ||
         isSeldomRectangle(frame.settings, light);
}

int sourceOf(const ShadowMap& map) { return (map.cube.enabled ? 2 : 0) + (map.array ? 1 : 0); }

void copy(Light& light, FrameTextures::Shadow& textures) {
  ShadowMap& map = light.shadow;
  const int width = textures.width, height = textures.height;
  textures.copySource = sourceOf(map);
  textures.width = textures.height = 0;
  for (std::size_t i = 0; i < map.views.size(); ++i) {
    const Rectangle texels = optics::texelsOf(map.views[i], width, height);
    textures.copies.push_back(optics::copyBlock(light, static_cast<int>(i), texels, textures.rounding));
    textures.width = std::max(textures.width, texels.width);
    textures.height = std::max(textures.height, texels.height);
  }
  for (std::size_t i = 0; i < map.views.size(); ++i) {
    map.views[i].rectangle = {0, 0, textures.copies[i].copiedSize.x, textures.copies[i].copiedSize.y};
    map.views[i].layer = static_cast<int>(i);
  }
  map.array = true;
  map.cube = {};
  map.encoding = DepthEncoding::Window;
  map.scale = {};
}

} // namespace

Frame withCubeViews(const Frame& frame) {
  Frame result = frame;
  for (Light& light : result.lights)
    if (light.shadow.texture != 0 && light.shadow.cube.enabled) light.shadow.views = optics::cubeViews(light);
  return result;
}

void chooseCopies(Frame& frame, FrameTextures& textures) {
  for (std::size_t i = 0; i < frame.lights.size(); ++i)
    if (frame.lights[i].shadow.texture != 0 && isCopied(frame, frame.lights[i]))
      copy(frame.lights[i], textures.shadows[i]);
}

} // namespace tyndall
