// Insertion of one segment into a curve (Salvi 2013, 4.1): the product of two transmittances, with a node at the segment's entry and one at its
// exit. Needs lib/avsmCurve with room for two more nodes. Nodes in no use stand at kTyndallUnused, so that nothing here asks how many are used.

// What an even segment lets through up to a depth; what it lets through of 1e-7 or less is taken for nothing. perDepth: of the
// logarithm, from entry to exit.
float tyndallPassed(vec3 segment, float perDepth, float depth) {
  float inside = exp(perDepth * min(depth - segment.x, segment.y - segment.x));
  return depth <= segment.x ? 1.0 : depth >= segment.y ? segment.z : inside;
}

// The curve just behind a depth.
float tyndallCurveBehind(float depth) {
  vec2 before = vec2(-1.0, 1.0), behind = vec2(kTyndallUnused, 1.0);
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) before = tyndallCurve[i].x <= depth ? tyndallCurve[i] : before;
  for (int i = TYNDALL_CURVE_ROOM - 1; i >= 0; --i) behind = tyndallCurve[i].x > depth ? tyndallCurve[i] : behind;
  return behind.x == kTyndallUnused ? before.y : mix(before.y, behind.y, (depth - before.x) / (behind.x - before.x));
}

void tyndallInsertSegment(vec3 segment) {
  vec2 entry = vec2(segment.x, tyndallCurveBehind(segment.x)), exit = vec2(segment.y, tyndallCurveBehind(segment.y) * segment.z);
  float perDepth = (segment.z <= 1e-7 ? -16.0 : log(segment.z)) / max(segment.y - segment.x, 1e-9); // 1e-9: nothing is inside a step
  int entryAt = 0, exitAt = 1;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) {
    float depth = tyndallCurve[i].x;
    tyndallCurve[i].y *= tyndallPassed(segment, perDepth, depth);
    entryAt += depth <= segment.x ? 1 : 0;
    exitAt += depth <= segment.y ? 1 : 0;
  }
  for (int i = TYNDALL_CURVE_ROOM - 1; i >= 0; --i) {
    vec2 moved = i > exitAt ? tyndallCurve[max(i - 2, 0)] : i > entryAt ? tyndallCurve[max(i - 1, 0)] : i == entryAt ? entry : tyndallCurve[i];
    tyndallCurve[i] = i == exitAt ? exit : moved;
  }
  tyndallUsed += 2;
  for (int i = 0; i < 2; ++i)
    if (tyndallUsed > TYNDALL_CURVE_ROOM - 2) {
      tyndallRemoveCheapest();
      tyndallCurve[TYNDALL_CURVE_ROOM - 1].x = kTyndallUnused;
    }
}
