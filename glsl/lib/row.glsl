// The light of [from, end] of a camera ray as a draw for some shadow views sees it: each one's own part along the slice's row and,
// in the draw that has it (bringsOutside), what lies outside all views.

#if SHADOW_VIEWS > 0 && !defined(SKIPS_NODES)
void addOwned(Airlight light, ViewSegment segment, int slice, inout Light sum) { addRow(light, segment, slice, sum); }
#endif

Light rowShadowedLight(vec2 position, float from, float end, int slice) {
  return shadowedLight(position, from, min(end, visibleEnd), ivec2(firstView, drawnViews), bringsOutside != 0, slice);
}

#include "lib/stored.glsl"
