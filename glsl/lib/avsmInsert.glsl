// Insertion of one segment into a curve (Salvi 2013, 4.1): the product of two transmittances, with a node at the segment's entry and one at its
// exit. Needs lib/avsmCurve with room for two more nodes, which must all stand at kUnused with 1 before the first segment: nodes in no use keep
// the value of the last one, so that nothing here asks how many are used.

const float kUnused = 2.0; // behind the far plane

// What a segment of an optical depth lets through up to a depth.
float passedIn(vec3 segment, float whole, float perDepth, float depth) {
  float inside = passedAt(whole * min((depth - segment.x) * perDepth, 1.0));
  return depth <= segment.x ? 1.0 : depth >= segment.y ? segment.z : inside;
}

// The curve at a depth, of two nodes that stand there the later.
float curveAt(float depth) {
  vec2 before = vec2(-1.0, 1.0), behind = vec2(kUnused, 1.0);
  for (int i = 0; i < ROOM; ++i) before = curve[i].x <= depth ? curve[i] : before;
  for (int i = ROOM - 1; i >= 0; --i) behind = curve[i].x > depth ? curve[i] : behind;
  return behind.x == kUnused ? before.y : mix(before.y, behind.y, (depth - before.x) / (behind.x - before.x));
}

void insertSegment(vec3 segment) {
  vec2 entry = vec2(segment.x, curveAt(segment.x)), exit = vec2(segment.y, curveAt(segment.y) * segment.z);
  float whole = opticalDepth(segment.z), perDepth = 1.0 / max(segment.y - segment.x, 1e-9); // 1e-9: of a step nothing is inside
  int entryAt = 0, exitAt = 1;
  for (int i = 0; i < ROOM; ++i) {
    curve[i].y *= passedIn(segment, whole, perDepth, curve[i].x);
    entryAt += curve[i].x <= segment.x ? 1 : 0;
    exitAt += curve[i].x <= segment.y ? 1 : 0;
  }
  for (int i = ROOM - 1; i >= 0; --i) {
    vec2 node = i > exitAt ? curve[max(i - 2, 0)] : i > entryAt ? curve[max(i - 1, 0)] : i == entryAt ? entry : curve[i];
    curve[i] = i == exitAt ? exit : node;
  }
  used += 2;
  for (int i = 0; i < 2; ++i)
    if (used > NODES) {
      removeCheapest();
      curve[ROOM - 1].x = kUnused;
    }
}
