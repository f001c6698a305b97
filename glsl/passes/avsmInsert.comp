// AVSM insert: each texel's curve from its list, segment by segment in the list's order, with as many nodes removed as came too many (Salvi
// 2013, 3.2 and 4.1). Reads the lists. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  tyndallEmptyCurve();
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) tyndallInsertSegment(segmentAt(at));
  tyndallPadCurve();
  storeCurve(texel);
}
