// AVSM insert: each texel's curve from its list, segment by segment in the list's order, with as many nodes removed as came too many (Salvi
// 2013, 3.2 and 4.1). With SPARE more nodes than are kept, which go when all segments are in: what little order leaves out is then found among
// them; and where there is room, thick segments fall as exponentials do. Reads the lists. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + SPARE + 2)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmInsert.glsl"
#if SPARE
#include "lib/avsmFit.glsl"

const int kPairs = (TYNDALL_CURVE_ROOM - 2) / 2; // segments of which all nodes are there

// From all nodes in use, more than are kept, to those. Where all ends are there, what lies between two is even; else as good as a line.
void removeSpare(bool isEven) {
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    vec2 a = tyndallCurve[i], b = i + 1 < tyndallUsed ? tyndallCurve[min(i + 1, TYNDALL_CURVE_ROOM - 1)] : a;
    integrals[i] = integralsBetween(a, b, isEven ? sqrt(a.y * b.y) : 0.5 * (a.y + b.y));
  }
  for (; tyndallUsed > TYNDALL_CURVE_NODES; --tyndallUsed) removeCheapestBefore(tyndallUsed - 1);
  fitValues();
  makeMonotone();
}

// In how many parts an even segment is inserted, one of so many in its list: a quarter of optical depth each, for which a line bends by less
// than a hundredth of an exponential, as far as there is room for their nodes.
int partsOf(vec3 segment, uint count) {
  float room = float(kPairs) / float(count);
  return segment.y > segment.x ? int(max(min(ceil(4.0 * opticalDepth(segment.z)), room), 1.0)) : 1;
}

vec3 partOf(vec3 segment, int part, int parts) {
  vec2 ends = mix(segment.xx, segment.yy, vec2(part, part + 1) / float(parts));
  float passed = exp(opticalDepth(segment.z) / float(-parts));
  if (part + 1 < parts) return vec3(ends, passed);
  return vec3(parts > 1 ? ends.x : segment.x, segment.y, parts > 1 && segment.z > 1e-7 ? passed : segment.z);
}
#endif

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  uint list = listOf(texel);
  tyndallEmptyCurve();
#if SPARE
  int part = 0;
  for (uint at = tyndallLists[list].head; at != kTyndallEnd;) { // one loop: in two nested ones compilers carry the curve about
    vec3 segment = segmentAt(at);
    int parts = partsOf(segment, tyndallLists[list].count);
    tyndallInsertSegment(partOf(segment, part, parts));
    bool last = ++part >= parts;
    part = last ? 0 : part;
    at = last ? tyndallSegments[at].w : at;
  }
  if (tyndallUsed > TYNDALL_CURVE_NODES) removeSpare(tyndallLists[list].count <= uint(kPairs));
#else
  for (uint at = tyndallLists[list].head; at != kTyndallEnd; at = tyndallSegments[at].w) tyndallInsertSegment(segmentAt(at));
#endif
  tyndallPadCurve();
  storeCurve(texel);
}
