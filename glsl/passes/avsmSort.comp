// AVSM sort: puts each texel's list of segments in the order of their entries (EXITS 0) or, besides, in that of their exits (EXITS 1), which is
// one order for the same segments however they came. Runs of RUN segments are sorted in registers by a network (Batcher 1968), then merged by
// their links, which needs no memory. Reads and writes the lists.
#define RUN 16
#include "lib/avsm.glsl"

#if EXITS
uint next(uint at) { return exitLinks[at]; }
uvec4 segmentWithNext(uint at) { return uvec4(tyndallSegments[at].yxz, exitLinks[at]); }
void link(uint at, uint to) { exitLinks[at] = to; }
#else
uint next(uint at) { return tyndallSegments[at].w; }
uvec4 segmentWithNext(uint at) { return tyndallSegments[at]; }
void link(uint at, uint to) { tyndallSegments[at].w = to; }
#endif

// Of the end that is sorted by, the other end, and transmittance: bits of floats that are not negative are in the order of the floats.
bool isBefore(uvec3 p, uvec3 q) { return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z; }

uvec4 run[RUN]; // what is sorted by, and where it is

void exchange(int low, int high) {
  uvec4 a = run[low], b = run[high];
  bool swapped = isBefore(b.xyz, a.xyz);
  run[low] = swapped ? b : a;
  run[high] = swapped ? a : b;
}

#define EXCHANGE(PARTNER) \
  for (int i = 0; i < RUN; ++i) \
    if ((i ^ (PARTNER)) > i) exchange(i, i ^ (PARTNER));

void sortRun() {
  EXCHANGE(1)
  EXCHANGE(3) EXCHANGE(1)
  EXCHANGE(7) EXCHANGE(2) EXCHANGE(1)
  EXCHANGE(15) EXCHANGE(4) EXCHANGE(2) EXCHANGE(1)
}

// Sorts runs and leaves them one behind the other; returns the head. In the list that is read the links of entries lead on.
uint sortedRuns(uint head) {
  uint at = head, sorted = kTyndallEnd, tail = kTyndallEnd;
  while (at != kTyndallEnd) {
    for (int i = 0; i < RUN; ++i) {
      bool ended = at == kTyndallEnd;
      uvec4 segment = ended ? uvec4(kTyndallEnd) : tyndallSegments[at];
#if EXITS
      segment.xy = segment.yx;
#endif
      run[i] = uvec4(segment.xyz, at);
      at = segment.w;
    }
    sortRun();
    for (int i = 0; i < RUN; ++i) {
      uint own = run[i].w;
      if (own == kTyndallEnd) continue;
      if (tail == kTyndallEnd) sorted = own;
      else link(tail, own);
      tail = own;
    }
  }
  if (tail != kTyndallEnd) link(tail, kTyndallEnd);
  return sorted;
}

// Merges neighbouring runs of a length; returns the head. `merges` counts them: after at most one all is in order.
uint mergedRuns(uint head, int size, out int merges) {
  uint p = head, sorted = kTyndallEnd, tail = kTyndallEnd;
  merges = 0;
  while (p != kTyndallEnd) {
    ++merges;
    uint q = p;
    int left = 0, right = size;
    for (; left < size && q != kTyndallEnd; ++left) q = next(q);
    uvec4 fromLeft = segmentWithNext(p), fromRight = segmentWithNext(q == kTyndallEnd ? p : q);
    right = q == kTyndallEnd ? 0 : right;
    while (left > 0 || right > 0) {
      bool isLeft = left > 0 && (right == 0 || !isBefore(fromRight.xyz, fromLeft.xyz));
      uint taken = isLeft ? p : q, follower = isLeft ? fromLeft.w : fromRight.w;
      uvec4 segment = segmentWithNext(follower == kTyndallEnd ? taken : follower);
      p = isLeft ? follower : p;
      q = isLeft ? q : follower;
      fromLeft = isLeft ? segment : fromLeft;
      fromRight = isLeft ? fromRight : segment;
      left -= isLeft ? 1 : 0;
      right = isLeft ? right : follower == kTyndallEnd ? 0 : right - 1;
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
  uint head = sortedRuns(tyndallLists[list].head);
  for (int size = RUN; size < int(min(tyndallLists[list].count, tyndallMost)); size *= 2) {
    int merges;
    head = mergedRuns(head, size, merges);
    if (merges <= 1) break;
  }
#if EXITS
  tyndallLists[list].exits = head;
#else
  tyndallLists[list].head = head;
#endif
}
