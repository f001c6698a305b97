// What of a light and a frame selects a program.
#pragma once

#include "gl/Variant.h"

#include <vector>

namespace tyndall {

/// HEIGHT of glsl/lib/height.glsl: how the medium thins out with height. Not at all; all of it by its only layer,
/// before a sun that loses nothing on its way; a part of it by that; in any way.
inline constexpr int kNoLayers = 0, kOnlyLayer = 1, kOneLayer = 2, kAnyLayers = 3;

struct LightVariant {
  int lightKind = 0;   ///< 0 directional, 1 point, 2 spot
  int shadowViews = 0; ///< 0, 1, or 2 for several
  bool shadowArray = false;
  bool bilinear = false;
  bool glass = false;
  bool curves = false;    ///< smoke and hair dim the light (Light::curves)
  bool eyeCurves = false; ///< and what comes to the eye (Frame::eyeCurves),
  bool fog = false;       ///< of what it takes a part is scattered
  int layers = kNoLayers;
  bool monochrome = false;
  bool composite = false; ///< dual-source outputs of unwarp and transmittance instead of two targets
  bool dualSource = true; ///< the context has such outputs, and uses them
  bool cubeArrays = true; ///< the context has arrays of cube maps

  bool hasShares() const { return shadowViews > 0 && (glass || bilinear); }
  bool isColoured() const { return !monochrome || glass; } ///< three channels of radiance
};

gl::Definitions definitionsOf(const LightVariant& variant);

/// The one whose programs draw a variant: grey media have programs of their own where they save most, with a light of
/// one filter, glass or smoke, or a sun of glass and smoke; media with one layer with a light of none of these. Before
/// curves at the eye there are no others, and they write to two targets.
LightVariant served(LightVariant variant);

/// Every variant that a frame can ask for in a context with dual-source blending, or without.
std::vector<LightVariant> allLightVariants(bool dualSource);

} // namespace tyndall
