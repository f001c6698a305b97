// Insertion of one segment into a curve (Salvi 2013, 4.1): the product of two transmittances, with a node at the segment's entry and one at its
// exit. Needs lib/avsmCurve with room for two more nodes.

float passedIn(vec3 segment, float depth) {
  if (depth <= segment.x) return 1.0;
  if (depth >= segment.y) return segment.z;
  return passedAt(opticalDepth(segment.z) * (depth - segment.x) / (segment.y - segment.x));
}

// The curve at a depth; `behind` takes the later of two nodes that stand there.
float curveAt(float depth, bool behind) {
  float passed = 1.0;
  vec2 before = vec2(0.0, 1.0);
  for (int i = 0; i < ROOM; ++i) {
    if (i >= used) break;
    vec2 node = curve[i];
    if (node.x < depth || (behind && node.x == depth)) passed = node.y;
    else if (i > 0 && before.x < depth) passed = mix(before.y, node.y, (depth - before.x) / (node.x - before.x));
    if (node.x > depth) break;
    before = node;
  }
  return passed;
}

void insertSegment(vec3 segment) {
  vec2 entry = vec2(segment.x, curveAt(segment.x, true)), exit = vec2(segment.y, curveAt(segment.y, true) * segment.z);
  int entryAt = 0, exitAt = 1;
  for (int i = 0; i < ROOM; ++i) {
    if (i >= used) break;
    curve[i].y *= curve[i].x <= segment.x ? 1.0 : passedIn(segment, curve[i].x);
    if (curve[i].x <= segment.x) ++entryAt;
    if (curve[i].x <= segment.y) ++exitAt;
  }
  for (int i = ROOM - 1; i >= 0; --i) {
    vec2 node = curve[i];
    if (i == exitAt) node = exit;
    else if (i > exitAt) node = curve[max(i - 2, 0)];
    else if (i == entryAt) node = entry;
    else if (i > entryAt) node = curve[max(i - 1, 0)];
    curve[i] = node;
  }
  used += 2;
  for (int i = 0; i < 2; ++i)
    if (used > NODES) removeCheapest();
}
