// A curve of at most TYNDALL_CURVE_ROOM nodes, of which TYNDALL_CURVE_NODES are to be kept: depth and transmittance, nearest first. All indices
// are static once loops are unrolled, for which no loop ends early, so that it stays in registers (Salvi 2013, 4.2).

vec2 tyndallCurve[TYNDALL_CURVE_ROOM];
int tyndallUsed = 0;
const float kTyndallUnused = 2.0; // depth of nodes in no use: behind the far plane

void tyndallEmptyCurve() {
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i] = vec2(kTyndallUnused, 1.0);
  tyndallUsed = 0;
}

// Change of the integral, twice, when a node is removed (Salvi 2013, 3.2.1).
float tyndallArea(vec2 a, vec2 b, vec2 c) { return abs((c.x - a.x) * (c.y - b.y) - (c.x - b.x) * (c.y - a.y)); }

// Removes the inner node that changes the curve's integral least. The first and the last one stay.
void tyndallRemoveCheapest() {
  float least = 3e38;
  int cheapest = 1;
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i) {
    float area = tyndallArea(tyndallCurve[i - 1], tyndallCurve[i], tyndallCurve[i + 1]);
    if (i < tyndallUsed - 1 && area < least) {
      least = area;
      cheapest = i;
    }
  }
  for (int i = 1; i < TYNDALL_CURVE_ROOM - 1; ++i)
    if (i >= cheapest) tyndallCurve[i] = tyndallCurve[i + 1];
  --tyndallUsed;
}

// Fills what is left behind the last node with copies of it; an empty curve, with nodes at the far plane through which all passes.
void tyndallPadCurve() {
  vec2 last = vec2(1.0);
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) {
    if (i < tyndallUsed) last = tyndallCurve[i];
    else tyndallCurve[i] = last;
  }
}
