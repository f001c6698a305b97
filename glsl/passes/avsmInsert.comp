// AVSM insert: each texel's curve from its list, segment by segment in the list's order, with as many nodes removed as came too many (Salvi
// 2013, 3.2 and 4.1). Reads the lists. Writes curves.
#define ROOM (NODES + 2)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmInsert.glsl"

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  for (int i = 0; i < ROOM; ++i) curve[i] = vec2(kUnused, 1.0);
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) insertSegment(segmentAt(at));
  padCurve();
  storeCurve(texel);
}
