#include "passes/Exact.h"

namespace tyndall::passes::exact {

gl::Definitions definitionsOf(const Variant& v) {
  return {{"LIGHT_KIND", v.lightKind},
          {"SHADOW_VIEWS", v.shadowViews},
          {"SHADOW_ARRAY", v.shadowArray},
          {"FILTER_BILINEAR", v.bilinear},
          {"GLASS", v.glass},
          {"CURVES", v.curves},
          {"MONOCHROME", v.monochrome},
          {"DEPTH_MULTISAMPLED", v.multisampled},
          {"COMPOSITE", v.composite}};
}

std::vector<Variant> allVariants() {
  std::vector<Variant> all;
  for (const bool composite : {false, true})
    for (const bool multisampled : {false, true}) {
      Variant v;
      v.composite = composite;
      v.multisampled = multisampled;
      for (const bool monochrome : {false, true}) {
        v.monochrome = monochrome;
        v.lightKind = 3;
        v.shadowViews = 0;
        v.shadowArray = v.bilinear = v.glass = v.curves = false;
        all.push_back(v);
        for (v.lightKind = 0; v.lightKind < 3; ++v.lightKind) {
          v.shadowViews = 0;
          v.shadowArray = v.bilinear = v.glass = v.curves = false;
          all.push_back(v);
          for (int bits = 0; bits < (composite ? 8 : 16); ++bits) {
            v.shadowArray = (bits & 1) != 0;
            v.bilinear = (bits & 2) != 0;
            v.glass = (bits & 4) != 0;
            v.curves = (bits & 8) != 0;
            for (v.shadowViews = 1; v.shadowViews <= (v.lightKind != 2 ? 2 : 1); ++v.shadowViews)
              all.push_back(v);
          }
        }
      }
    }
  return all;
}

bool run(const PassContext& context, const In& in) {
  bindTexture(context, gl::Unit::SceneDepth, in.variant.multisampled ? gl::TEXTURE_2D_MULTISAMPLE : gl::TEXTURE_2D,
              in.sceneDepth);
  if (in.variant.shadowViews > 0) {
    const gl::Enum target = in.variant.shadowArray ? gl::TEXTURE_2D_ARRAY : gl::TEXTURE_2D;
    bindTexture(context, gl::Unit::ShadowMap, target, in.light->shadow.texture);
    if (in.variant.glass) {
      bindTexture(context, gl::Unit::GlassColour, target, in.light->glass.colour);
      bindTexture(context, gl::Unit::GlassDepth, target, in.light->glass.depth);
    }
    if (in.variant.curves) bindTexture(context, gl::Unit::Curves, gl::TEXTURE_2D_ARRAY, in.light->curves.texture);
  }
  setBlend(context, in.blend);
  return drawFullScreen(context, "passes/exact.frag", definitionsOf(in.variant));
}

} // namespace tyndall::passes::exact
