// From more nodes of a curve to as many as are kept: those go without which a line is nearest to what was there at first, and the values of the
// others are fitted by least squares, never rising (Salvi 2013, 3.2.1, but over a whole curve, and by what all removals so far have changed).
// Needs lib/avsmCurve. Loops have one static step each and no condition that leaves early: else compilers keep the curve in memory.

// Of the stretch from each node to the next: integrals of the transmittance as it was, and of it times the depth from the stretch's begin on.
vec2 integrals[TYNDALL_CURVE_ROOM];

// Of a stretch from node a to node b that lets so much through in its middle: by Simpson's rule, exact for a line and, as the root of what passes at its
// ends, for the square that an even medium's transmittance is taken for.
vec2 integralsBetween(vec2 a, vec2 b, float middle) {
  float size = b.x - a.x;
  return vec2(a.y + 4.0 * middle + b.y, (2.0 * middle + b.y) * size) * (size * (1.0 / 6.0));
}

// Removes an inner node, of those in front of the last one; its stretches become one. It is the node for which the square of the mean difference
// times the length, which the square of the difference is at least, is least; one that is another again costs nothing.
void removeCheapestBefore(int last) {
  float least = 3e38;
  int cheapest = 1;
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) {
    vec2 a = tyndallCurve[i - 1], b = tyndallCurve[i], c = tyndallCurve[i + 1];
    float size = c.x - a.x, changed = integrals[i - 1].x + integrals[i].x - 0.5 * (a.y + c.y) * size;
    float cost = b == a || b == c ? 0.0 : changed * changed / max(size, 1e-12);
    cost = i < last ? cost : 3e38;
    cheapest = cost < least ? i : cheapest;
    least = min(cost, least);
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM; ++i) {
    vec2 joined = integrals[i - 1] + integrals[i] + vec2(0.0, (tyndallCurve[i].x - tyndallCurve[i - 1].x) * integrals[i].x);
    integrals[i - 1] = i == cheapest ? joined : i > cheapest ? integrals[i] : integrals[i - 1];
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) tyndallCurve[i] = i >= cheapest ? tyndallCurve[i + 1] : tyndallCurve[i];
}

// Values of the inner nodes so that the curve, of lines, is nearest to what the integrals are of in the mean square; the ends keep theirs.
void fitValues() {
  const int last = TYNDALL_CURVE_NODES - 1;
  float lengths[TYNDALL_CURVE_NODES], rising[TYNDALL_CURVE_NODES]; // of stretches; integrals of the transmittance times what rises there from 0 to 1
  for (int i = 0; i < last; ++i) {
    lengths[i] = tyndallCurve[i + 1].x - tyndallCurve[i].x;
    rising[i] = integrals[i].y / max(lengths[i], 1e-12); // 1e-12: nothing is integrated over no length
  }
  // A tridiagonal system, from the first inner node to the last: a third of the lengths beside each, a sixth between.
  float slope[TYNDALL_CURVE_NODES], offset[TYNDALL_CURVE_NODES]; // value i = offset i - slope i * value i + 1
  slope[0] = 0.0;
  offset[0] = tyndallCurve[0].y;
  for (int i = 1; i < last; ++i) {
    float before = lengths[i - 1], behind = lengths[i], product = rising[i - 1] + (integrals[i].x - rising[i]);
    float diagonal = (before + behind) / 3.0 - before / 6.0 * slope[i - 1];
    // A node without length on either side keeps its value, and so does another one at the first.
    bool keeps = diagonal <= 1e-12 || tyndallCurve[i] == tyndallCurve[0];
    float inverse = 1.0 / max(diagonal, 1e-12);
    slope[i] = keeps ? 0.0 : behind / 6.0 * inverse;
    offset[i] = keeps ? tyndallCurve[i].y : (product - before / 6.0 * offset[i - 1]) * inverse;
  }
  float next = tyndallCurve[last].y;
  for (int i = last - 1; i > 0; --i) {
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
