// The answer that the shadow maps imply: every texel along every pixel's ray, in double precision.
//
// Visibility of a point, the same for the effect's technique `exact`:
// - It belongs to the first shadow view that holds it: inside the side planes, clip w > 0, at or beyond the near plane
//   and, for all cascades but the last of a directional light, not beyond the far plane.
// - In no view it is lit if Light::litOutsideViews; else only where some view holds it but for lying before its near
// plane.
// - Nearest: lit unless its depth is beyond that of the texel that contains it. A texel at the far value holds no
// caster.
// - Bilinear: the four texel centres around it, clamped to the edge, are compared with the point's own depth and
//   weighted bilinearly.
// - Glass: a texel's colour applies where the point's depth is strictly beyond the texel's glass depth.
// Depth directions are read off the matrices.
#pragma once

#include "Ambient.h"
#include "Curves.h"
#include "Ray.h"

#include <tyndall/tyndall.h>

namespace reference {

/// A light's maps as read back from GL: layer by layer, row 0 at the bottom.
struct ShadowImage {
  int width = 0; ///< 0: nothing blocks or tints the light
  int height = 0;
  int layers = 1;
  std::vector<float> depth;       ///< window depth; empty: nothing blocks the light
  std::vector<float> glassColour; ///< RGB, three floats a texel; empty: no glass
  std::vector<float> glassDepth;  ///< window depth
};

struct MapScene {
  tyndall::Camera camera;
  std::vector<tyndall::Light> lights; ///< texture names are not looked at, shadow.views and shadow.clipDepth are
  std::vector<ShadowImage> shadows;   ///< one a light, or none at all
  std::vector<CurveMap> curves;       ///< one a light, or none at all: in steps, not in closed form
  EyeCurveMap eyeCurves;              ///< as curves
  tyndall::Medium medium;
  tyndall::Ambient ambient; ///< but for its texture:
  Occlusion occlusion;
  tyndall::ShadowFilter filter = tyndall::ShadowFilter::Nearest;
  int width = 0;
  int height = 0;
  int samples = 1;          ///< depth values a pixel; the answer is their mean, all along the ray of the pixel's centre
  std::vector<float> depth; ///< window depth in [0, 1], row 0 at the bottom, a pixel's samples side by side
};

/// All pixels. Throws std::invalid_argument where an array has the wrong size.
ImageAnswer mapExact(const MapScene& scene);

/// Some pixels, in the order given.
std::vector<PixelAnswer> mapExact(const MapScene& scene, const std::vector<glm::ivec2>& pixels);

} // namespace reference
