// AVSM reduce: each texel's curve from its segments in order, of entries and of exits: of all ends of segments, where the transmittance is
// known exactly, those nodes are kept that it would change most without, and their values fitted by least squares, never rising (the removal of
// Salvi 2013, 3.2.1, over the whole curve instead of in the order of insertion). Reads the lists, sorted both ways. Writes curves.
#define TYNDALL_CURVE_ROOM 32
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmWalk.glsl"

void keepNodes(uint list) {
  Walk walk = startWalk(list);
  while (!isOver(walk)) {
    if (!nextNode(walk)) continue;
    if (tyndallUsed == TYNDALL_CURVE_ROOM) tyndallRemoveCheapest();
    vec2 node = nodeOf(walk);
    for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i)
      if (i == tyndallUsed) tyndallCurve[i] = node;
    ++tyndallUsed;
  }
  while (tyndallUsed > TYNDALL_CURVE_NODES) tyndallRemoveCheapest();
}

// What the least squares need: integrals of the transmittance times each node's hat function.
float products[TYNDALL_CURVE_NODES];

// The stretch between two nodes of the walk lies between two that were kept. Simpson's rule, exact for the square that the transmittance is
// taken for.
void addProducts(vec2 a, vec2 b) {
  float middle = sqrt(a.y * b.y), size = (b.x - a.x) / 6.0;
  for (int i = 0; i + 1 < TYNDALL_CURVE_NODES; ++i) {
    float low = tyndallCurve[i].x, high = tyndallCurve[i + 1].x;
    if (a.x < low || b.x > high || high <= low || i + 1 >= tyndallUsed) continue;
    float p = (a.x - low) / (high - low), q = (b.x - low) / (high - low), m = 0.5 * (p + q);
    products[i] += size * (a.y * (1.0 - p) + 4.0 * middle * (1.0 - m) + b.y * (1.0 - q));
    products[i + 1] += size * (a.y * p + 4.0 * middle * m + b.y * q);
  }
}

float lengthAt(int i) { return i >= 0 && i + 1 < tyndallUsed ? tyndallCurve[min(i + 1, TYNDALL_CURVE_NODES - 1)].x - tyndallCurve[i].x : 0.0; }

// Values of the inner nodes so that the curve, of lines, is nearest to the walk's in the mean square; the ends keep theirs.
void fitValues(uint list) {
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) products[i] = 0.0;
  Walk walk = startWalk(list);
  vec2 last = vec2(-1.0);
  while (!isOver(walk)) {
    if (!nextNode(walk)) continue;
    vec2 node = nodeOf(walk);
    if (last.x >= 0.0 && node.x > last.x) addProducts(last, node);
    last = node;
  }
  // A tridiagonal system, from the first inner node to the last: half a length beside each, a sixth between.
  float slope[TYNDALL_CURVE_NODES], offset[TYNDALL_CURVE_NODES]; // value i = offset i - slope i * value i + 1
  slope[0] = 0.0;
  offset[0] = tyndallCurve[0].y;
  for (int i = 1; i < TYNDALL_CURVE_NODES; ++i) {
    float before = lengthAt(i - 1), behind = lengthAt(i), diagonal = (before + behind) / 3.0 - before / 6.0 * slope[i - 1];
    bool inner = i < tyndallUsed - 1 && diagonal > 1e-12; // a node without length on either side keeps its value
    slope[i] = inner ? behind / 6.0 / diagonal : 0.0;
    offset[i] = inner ? (products[i] - before / 6.0 * offset[i - 1]) / diagonal : tyndallCurve[i].y;
  }
  float next = 0.0;
  for (int i = TYNDALL_CURVE_NODES - 1; i >= 0; --i) {
    next = offset[i] - slope[i] * next;
    if (i < tyndallUsed) tyndallCurve[i].y = next;
  }
}

// Between the lowest value before and the highest behind: falls wherever the values do not. The ends keep theirs.
void makeMonotone() {
  float highest[TYNDALL_CURVE_NODES], lowest = 1.0, end = 0.0;
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i)
    if (i == tyndallUsed - 1) end = tyndallCurve[i].y;
  for (int i = TYNDALL_CURVE_NODES - 1; i >= 0; --i)
    highest[i] = max(i < tyndallUsed ? tyndallCurve[i].y : end, i + 1 < TYNDALL_CURVE_NODES ? highest[min(i + 1, TYNDALL_CURVE_NODES - 1)] : 0.0);
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) {
    if (i >= tyndallUsed) break;
    lowest = clamp(tyndallCurve[i].y, end, lowest);
    tyndallCurve[i].y = clamp(0.5 * (lowest + highest[i]), 0.0, 1.0);
  }
}

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  uint list = listOf(texel);
  tyndallEmptyCurve();
  if (tyndallLists[list].count > 0u) {
    keepNodes(list);
    if (tyndallUsed > 2) fitValues(list);
    makeMonotone();
  }
  tyndallPadCurve();
  storeCurve(texel);
}
