// AVSM insert: each texel's curve from its list, segment by segment in the list's order, with as many nodes removed as came too many (Salvi
// 2013, 3.2 and 4.1). With SPARE more nodes than are kept, which go when all segments are in: what little order leaves out is then found among
// them. Reads the lists. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + SPARE + 2)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"
#if SPARE
#include "lib/avsmFit.glsl"

// From all nodes in use, more than are kept, to those.
void removeSpare() {
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    vec2 a = tyndallCurve[i], b = tyndallCurve[min(i + 1, TYNDALL_CURVE_ROOM - 1)];
    float size = i + 1 < tyndallUsed ? b.x - a.x : 0.0;
    integrals[i] = vec2(0.5 * (a.y + b.y), (a.y + 2.0 * b.y) * size * (1.0 / 6.0)) * size;
  }
  for (; tyndallUsed > TYNDALL_CURVE_NODES; --tyndallUsed) removeCheapestBefore(tyndallUsed - 1);
  fitValues();
  makeMonotone();
}
#endif

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  tyndallEmptyCurve();
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) tyndallInsertSegment(segmentAt(at));
#if SPARE
  if (tyndallUsed > TYNDALL_CURVE_NODES) removeSpare();
#endif
  tyndallPadCurve();
  storeCurve(texel);
}
