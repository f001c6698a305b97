// AVSM reduce: each texel's curve from its segments in order, of entries and of exits: of all ends of segments, where the transmittance is
// known exactly, those nodes are kept that it would change most without, and their values fitted by least squares, never rising (the removal of
// Salvi 2013, 3.2.1, over the whole curve instead of in the order of insertion). Reads the lists, sorted both ways. Writes curves.
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 8)
#include "lib/avsm.glsl"
#include "lib/avsmCurve.glsl"
#include "lib/avsmImage.glsl"
#include "lib/avsmWalk.glsl"

// Of the stretch from each node to the next: integrals of the transmittance, and of it times the depth from the stretch's begin on.
vec2 integrals[TYNDALL_CURVE_ROOM];

// Simpson's rule, exact for the square that the transmittance is taken for.
vec2 integralsBetween(vec2 a, vec2 b) {
  float size = b.x - a.x, middle = sqrt(a.y * b.y);
  return vec2(a.y + 4.0 * middle + b.y, (2.0 * middle + b.y) * size) * (size / 6.0);
}

// Removes the inner node that changes the curve's integral least, of those in front of the last one; its stretches become one.
void removeCheapestBefore(int last) {
  float least = 3e38;
  int cheapest = 1;
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) {
    float area = i < last ? tyndallArea(tyndallCurve[i - 1], tyndallCurve[i], tyndallCurve[i + 1]) : 3e38;
    cheapest = area < least ? i : cheapest;
    least = min(area, least);
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM; ++i) {
    vec2 joined = integrals[i - 1] + integrals[i] + vec2(0.0, (tyndallCurve[i].x - tyndallCurve[i - 1].x) * integrals[i].x);
    integrals[i - 1] = i == cheapest ? joined : i > cheapest ? integrals[i] : integrals[i - 1];
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) tyndallCurve[i] = i >= cheapest ? tyndallCurve[i + 1] : tyndallCurve[i];
}

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
      integrals[TYNDALL_CURVE_ROOM - 2] = integralsBetween(before, node);
      tyndallCurve[TYNDALL_CURVE_ROOM - 1] = node;
    } else {
      --last;
    }
  }
}

float lengthAt(int i) { return i >= 0 && i + 1 < TYNDALL_CURVE_NODES ? tyndallCurve[min(i + 1, TYNDALL_CURVE_NODES - 1)].x - tyndallCurve[i].x : 0.0; }

// Values of the inner nodes so that the curve, of lines, is nearest to the walk's in the mean square; the ends keep theirs.
void fitValues() {
  float products[TYNDALL_CURVE_NODES]; // integrals of the transmittance times each node's hat function
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) products[i] = 0.0;
  for (int i = 0; i + 1 < TYNDALL_CURVE_NODES; ++i) {
    float rising = integrals[i].y / max(lengthAt(i), 1e-12); // 1e-12: nothing is integrated over no length
    products[i] += integrals[i].x - rising;
    products[i + 1] += rising;
  }
  // A tridiagonal system, from the first inner node to the last: a third of the lengths beside each, a sixth between.
  float slope[TYNDALL_CURVE_NODES], offset[TYNDALL_CURVE_NODES]; // value i = offset i - slope i * value i + 1
  slope[0] = 0.0;
  offset[0] = tyndallCurve[0].y;
  for (int i = 1; i < TYNDALL_CURVE_NODES; ++i) {
    float before = lengthAt(i - 1), behind = lengthAt(i), diagonal = (before + behind) / 3.0 - before / 6.0 * slope[i - 1];
    // A node without length on either side keeps its value, and so does another one at the first.
    bool inner = i < TYNDALL_CURVE_NODES - 1 && diagonal > 1e-12 && tyndallCurve[i] != tyndallCurve[0];
    slope[i] = inner ? behind / 6.0 / diagonal : 0.0;
    offset[i] = inner ? (products[i] - before / 6.0 * offset[i - 1]) / diagonal : tyndallCurve[i].y;
  }
  float next = 0.0;
  for (int i = TYNDALL_CURVE_NODES - 1; i >= 0; --i) {
    next = offset[i] - slope[i] * next;
    tyndallCurve[i].y = next;
  }
}

// Between the lowest value before and the highest behind: falls wherever the values do not. The ends keep theirs.
void makeMonotone() {
  float highest[TYNDALL_CURVE_NODES], lowest = 1.0, end = tyndallCurve[TYNDALL_CURVE_NODES - 1].y;
  for (int i = TYNDALL_CURVE_NODES - 1; i >= 0; --i) highest[i] = max(tyndallCurve[i].y, i + 1 < TYNDALL_CURVE_NODES ? highest[min(i + 1, TYNDALL_CURVE_NODES - 1)] : 0.0);
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) {
    lowest = clamp(tyndallCurve[i].y, end, lowest);
    tyndallCurve[i].y = clamp(0.5 * (lowest + highest[i]), 0.0, 1.0);
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
