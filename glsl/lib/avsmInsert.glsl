// Insertion of one segment into a curve (Salvi 2013, 4.1): the product of two transmittances, with a node at the segment's entry and one at its
// exit. Needs lib/avsmCurve with room for two more nodes.

// What an even segment lets through up to a depth between its ends; what it lets through of 1e-7 or less is taken for nothing.
float tyndallPassed(vec3 segment, float depth) {
  if (depth >= segment.y) return segment.z;
  if (depth <= segment.x) return 1.0;
  return exp((segment.z <= 1e-7 ? -16.0 : log(segment.z)) * (depth - segment.x) / (segment.y - segment.x));
}

// The curve just behind a depth.
float tyndallCurveBehind(float depth) {
  float passed = 1.0;
  bool past = false;
  vec2 before = vec2(0.0, 1.0);
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    vec2 node = tyndallCurve[i];
    if (i < tyndallUsed && !past) {
      past = node.x > depth;
      if (!past) passed = node.y;
      else if (i > 0) passed = mix(before.y, node.y, (depth - before.x) / (node.x - before.x));
      before = node;
    }
  }
  return passed;
}

void tyndallInsertSegment(vec3 segment) {
  vec2 entry = vec2(segment.x, tyndallCurveBehind(segment.x)), exit = vec2(segment.y, tyndallCurveBehind(segment.y) * segment.z);
  int entryAt = 0, exitAt = 1;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    float depth = tyndallCurve[i].x;
    if (i < tyndallUsed) {
      if (depth <= segment.x) ++entryAt;
      else tyndallCurve[i].y *= tyndallPassed(segment, depth);
      if (depth <= segment.y) ++exitAt;
    }
  }
  for (int i = TYNDALL_CURVE_ROOM - 1; i >= 0; --i) {
    vec2 node = tyndallCurve[i];
    if (i == exitAt) node = exit;
    else if (i > exitAt) node = tyndallCurve[max(i - 2, 0)];
    else if (i == entryAt) node = entry;
    else if (i > entryAt) node = tyndallCurve[max(i - 1, 0)];
    tyndallCurve[i] = node;
  }
  tyndallUsed += 2;
  for (int i = 0; i < 2; ++i)
    if (tyndallUsed > TYNDALL_CURVE_NODES) tyndallRemoveCheapest();
}
