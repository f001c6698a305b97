#include "plan/LightVariant.h"

namespace tyndall {

gl::Definitions definitionsOf(const LightVariant& v) {
  gl::Definitions definitions = {{"LIGHT_KIND", v.lightKind},
                                 {"SHADOW_VIEWS", v.shadowViews},
                                 {"SHADOW_ARRAY", v.shadowArray},
                                 {"FILTER_BILINEAR", v.bilinear},
                                 {"GLASS", v.glass},
                                 {"CURVES", v.curves},
                                 {"EYE_CURVES", v.eyeCurves},
                                 {"FOG", v.fog},
                                 {"HEIGHT", v.layers},
                                 {"MONOCHROME", v.monochrome},
                                 {"COMPOSITE", v.composite}};
  if (!v.dualSource) definitions.emplace_back("ONE_SOURCE", 1);
  return definitions;
}

LightVariant served(LightVariant variant) {
  const int kinds = (variant.bilinear ? 1 : 0) + (variant.glass ? 1 : 0) + (variant.curves ? 1 : 0);
  if (variant.layers != kNoLayers && (variant.shadowViews == 0 || kinds > 0 || variant.eyeCurves))
    variant.layers = kAnyLayers;
  const bool isSunThroughGlass =
      variant.lightKind == 0 && !variant.bilinear && variant.layers == kNoLayers; // and smoke
  const bool isMixture = kinds > 1 && !isSunThroughGlass;
  if (variant.layers == kAnyLayers || variant.shadowViews == 0 || isMixture || variant.eyeCurves)
    variant.monochrome = false;
  if (variant.eyeCurves) variant.composite = false;
  return variant;
}

std::vector<LightVariant> allLightVariants(bool dualSource) {
  std::vector<LightVariant> all;
  const auto add = [&](const LightVariant& variant) {
    for (const bool monochrome : {false, true})
      for (const bool composite : {false, true}) {
        if (composite && !dualSource) continue;
        LightVariant v = variant;
        v.dualSource = dualSource;
        v.monochrome = monochrome;
        v.composite = composite;
        all.push_back(served(v));
      }
  };
  const auto addKind = [&](int kind, int layers) {
    LightVariant v;
    v.lightKind = kind;
    v.layers = layers;
    add(v);
    v.eyeCurves = true;
    add(v);
    v.fog = true;
    add(v);
    for (int bits = 0; bits < 64; ++bits) {
      if ((bits & 48) == 32) continue; // fog is what curves before the eye stand for
      v.shadowArray = (bits & 1) != 0;
      v.bilinear = (bits & 2) != 0;
      v.glass = (bits & 4) != 0;
      v.curves = (bits & 8) != 0;
      v.eyeCurves = (bits & 16) != 0;
      v.fog = (bits & 32) != 0;
      for (v.shadowViews = 1; v.shadowViews <= (kind != 2 ? 2 : 1); ++v.shadowViews)
        add(v);
    }
  };
  for (int kind = 0; kind < 3; ++kind) {
    for (int layers = 0; layers <= kAnyLayers; ++layers)
      addKind(kind, layers);
  }
  return all;
}

} // namespace tyndall
