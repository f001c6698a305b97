// The light of [from, end] of a camera ray as a draw for some shadow views sees it: each one's own part along the slice's row and,
// in the draw that has it (bringsOutside), what lies outside all views.

#if SHADOW_VIEWS > 0 && !defined(SKIPS_NODES)
Light ownedLight(Airlight light, ViewSegment segment, int slice) { return rowLight(light, segment, slice); }
#endif

Light rowShadowedLight(Ray ray, float from, float end, int slice) {
  Airlight light = airlightOf(ray);
  float s0 = from, s1 = min(end, visibleEnd);
  litRange(light, s0, s1);
  return shadowedLight(light, ray, s0, s1, ivec2(firstView, drawnViews), bringsOutside != 0, slice);
}

#include "lib/stored.glsl"
