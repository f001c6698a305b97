// AVSM reduce: each texel's curve from its segments in order, of entries and of exits: of all ends of segments, where the transmittance is
// known exactly, those nodes are kept that count most. Reads the lists, sorted both ways. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 8)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmFit.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmWalk.glsl"

// Goes along all ends and keeps TYNDALL_CURVE_NODES of them. Places in no use hold the first node, which is the cheapest to remove as long as there are two.
void keepNodes(uint list) {
  Walk walk = startWalk(list);
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    tyndallCurve[i] = nodeOf(walk);
    integrals[i] = vec2(0.0);
  }
  int last = TYNDALL_CURVE_ROOM - 1;
  while (last >= TYNDALL_CURVE_NODES) {
    bool found = last == TYNDALL_CURVE_ROOM - 1 && !isOver(walk) && nextNode(walk);
    removeCheapestBefore(last);
    vec2 before = tyndallCurve[TYNDALL_CURVE_ROOM - 2], node = nodeOf(walk);
    if (found) {
      integrals[TYNDALL_CURVE_ROOM - 2] = integralsBetween(before, node, sqrt(before.y * node.y));
      tyndallCurve[TYNDALL_CURVE_ROOM - 1] = node;
    } else {
      --last;
    }
  }
}

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  uint list = listOf(texel);
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i] = vec2(1.0);
  if (tyndallLists[list].count > 0u) {
    keepNodes(list);
    fitValues();
    makeMonotone();
  }
  storeCurve(texel);
}
