// AVSM sort: puts each texel's list of segments in the order of their entries (EXITS 0) or, besides, in that of their exits (EXITS 1): a
// merge sort on the links, which needs no memory and gives one order for the same segments however they came. Runs of firstRun segments are in
// order already, of 2 lastRun afterwards: a driver may cut an invocation that loops for long short. Reads and writes the lists.
#include "lib/avsm.glsl"

uniform int firstRun;
uniform int lastRun;

#if EXITS
uint next(uint at) { return exitLinks[at]; }
void link(uint at, uint to) { exitLinks[at] = to; }
#else
uint next(uint at) { return tyndallSegments[at].w; }
void link(uint at, uint to) { tyndallSegments[at].w = to; }
#endif

bool isBefore(uint a, uint b) {
  vec3 p = segmentAt(a), q = segmentAt(b);
#if EXITS
  p = p.yxz;
  q = q.yxz;
#endif
  return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
}

// Merges neighbouring runs of a length; returns the head. `merges` counts them: after at most one all is in order.
uint mergedRuns(uint head, int run, out int merges) {
  uint p = head, sorted = kTyndallEnd, tail = kTyndallEnd;
  merges = 0;
  while (p != kTyndallEnd) {
    ++merges;
    uint q = p;
    int left = 0, right = run;
    for (; left < run && q != kTyndallEnd; ++left) q = next(q);
    while (left > 0 || (right > 0 && q != kTyndallEnd)) {
      bool fromLeft = left > 0 && (right == 0 || q == kTyndallEnd || !isBefore(q, p));
      uint taken = fromLeft ? p : q;
      if (fromLeft) {
        p = next(p);
        --left;
      } else {
        q = next(q);
        --right;
      }
      if (tail == kTyndallEnd) sorted = taken;
      else link(tail, taken);
      tail = taken;
    }
    p = q;
  }
  if (tail != kTyndallEnd) link(tail, kTyndallEnd);
  return sorted;
}

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  uint list = listOf(texel);
  if (tyndallLists[list].count <= uint(firstRun) && firstRun > 1) return;
  uint head = tyndallLists[list].head;
#if EXITS
  if (firstRun == 1)
    for (uint at = head; at != kTyndallEnd; at = tyndallSegments[at].w) exitLinks[at] = tyndallSegments[at].w;
  else head = tyndallLists[list].exits;
#endif
  for (int run = firstRun; run <= lastRun; run *= 2) {
    int merges;
    head = mergedRuns(head, run, merges);
    if (merges <= 1) break;
  }
#if EXITS
  tyndallLists[list].exits = head;
#else
  tyndallLists[list].head = head;
#endif
}
