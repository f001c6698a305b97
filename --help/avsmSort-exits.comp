#version 430 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define EXITS 1
// AVSM sort: puts each texel's list of segments in the order of their entries (EXITS 0) or, besides, in that of their exits (EXITS 1), which is
#define RUN 16

#define TYNDALL_LISTS_MEMORY // no two invocations look at one list

#ifndef TYNDALL_LISTS_BINDING
#define TYNDALL_LISTS_BINDING 0
#define TYNDALL_SEGMENTS_BINDING 1
#endif

#ifndef TYNDALL_LISTS_MEMORY
#define TYNDALL_LISTS_MEMORY coherent volatile // invocations look at each other's segments
#endif

#ifndef TYNDALL_SEGMENT
#define TYNDALL_SEGMENT

bool tyndallSegment(float entry, float exit, float transmittance, out vec3 segment) {
  segment = vec3(0.0, 0.0, 1.0);
  const float most = 1e37; // so that the difference of two is finite
  if (!(abs(entry) <= most) || !(abs(exit) <= most) || isnan(transmittance)) return false;
  float near = min(entry, exit), far = max(entry, exit), passed = transmittance > 0.0 ? min(transmittance, 1.0) : 0.0;
  if (near > 1.0) return false;
  if (far > 1.0) passed = near < 1.0 ? pow(passed, (1.0 - near) / (far - near)) : 1.0;
  segment = vec3(near > 0.0 ? near : 0.0, far > 0.0 ? min(far, 1.0) : 0.0, passed);
  return passed < 1.0;
}

#endif


struct TyndallList {
  uint head, count, deepest, exits; // the first segment, how many came, the entry that none here lies behind, the first by exit once sorted
};

layout(std430, binding = TYNDALL_LISTS_BINDING) TYNDALL_LISTS_MEMORY buffer TyndallLists {
  uint tyndallRoom;  // segments that the memory holds beyond one for each list
  uint tyndallTaken; // of these; more than there is room for once it has overflown
  uint tyndallLost;  // segments that were not kept
  uint tyndallMost;  // segments that a list may hold
  ivec3 tyndallSize; // width, height and layers of the map
  uint tyndallFirsts; // lists that hold anything
  TyndallList tyndallLists[];
};

layout(std430, binding = TYNDALL_SEGMENTS_BINDING) TYNDALL_LISTS_MEMORY buffer TyndallSegments {
  uvec4 tyndallSegments[]; // entry, exit and transmittance as bits of floats, and the next segment of the list
};

const uint kTyndallEnd = 0xFFFFFFFFu;
const uint kTyndallUnlinked = 0xFFFFFFFEu; // of a segment that the list begins with already: what comes next is about to be known
const uint kTyndallHeld = 0x80000000u;     // the sign of an entry whose segment is being exchanged

bool tyndallIsDeeper(uvec3 a, uvec3 b) { return a.x != b.x ? a.x > b.x : a.y != b.y ? a.y > b.y : a.z > b.z; }

void tyndallReplaceDeepest(uint list, uvec3 segment) {
  atomicAdd(tyndallLost, 1u);
  if (segment.x > tyndallLists[list].deepest) return;
  uint at = tyndallLists[list].head, attempts = 0u;
  for (uint i = 0u; i < 8u * tyndallMost && at < kTyndallUnlinked; ++i) {
    uvec4 other = tyndallSegments[at];
    bool busy = (other.x & kTyndallHeld) != 0u || other.w == kTyndallUnlinked;
    if (!busy && tyndallIsDeeper(other.xyz, segment)) {
      busy = atomicCompSwap(tyndallSegments[at].x, other.x, other.x | kTyndallHeld) != other.x;
      if (!busy) {
        memoryBarrierBuffer();
        other.yz = tyndallSegments[at].yz; // that of the entry, now that none changes it
        bool deeper = tyndallIsDeeper(other.xyz, segment);
        if (deeper) {
          tyndallSegments[at].y = segment.y;
          tyndallSegments[at].z = segment.z;
          memoryBarrierBuffer();
        }
        atomicExchange(tyndallSegments[at].x, deeper ? segment.x : other.x);
        if (deeper) segment = other.xyz;
      }
    }
    if (busy && ++attempts < 64u) continue;
    attempts = 0u;
    at = other.w;
  }
  if (at == kTyndallEnd) atomicMin(tyndallLists[list].deepest, segment.x);
}

void tyndallCapture(ivec3 texel, float entry, float exit, float transmittance) {
  if (any(lessThan(texel, ivec3(0))) || any(greaterThanEqual(texel, tyndallSize))) return;
  vec3 inMap;
  if (!tyndallSegment(entry, exit, transmittance, inMap)) return;
  uvec3 segment = floatBitsToUint(inMap);

  uint list = uint((texel.z * tyndallSize.y + texel.y) * tyndallSize.x + texel.x), lists = uint(tyndallSize.x * tyndallSize.y * tyndallSize.z);
  uint rank = atomicAdd(tyndallLists[list].count, 1u), at = list; // the first segment of a list has a place of its own
  if (rank == 0u) atomicAdd(tyndallFirsts, 1u);
  if (rank > 0u && rank < tyndallMost) at = lists + atomicAdd(tyndallTaken, 1u);
  if (rank < tyndallMost && at < lists + tyndallRoom) {
    tyndallSegments[at] = uvec4(segment, kTyndallUnlinked);
    memoryBarrierBuffer(); // whoever finds it finds it whole
    tyndallSegments[at].w = atomicExchange(tyndallLists[list].head, at);
  } else {
    tyndallReplaceDeepest(list, segment);
  }
}


layout(std430, binding = 2) buffer ExitLinks {
  uint exitLinks[]; // as the links of the segments, in the order of exits
};
layout(local_size_x = 8, local_size_y = 8) in;

ivec3 ownTexel() { return ivec3(gl_GlobalInvocationID); }
bool isOutside(ivec3 texel) { return any(greaterThanEqual(texel, tyndallSize)); }
uint listOf(ivec3 texel) { return uint((texel.z * tyndallSize.y + texel.y) * tyndallSize.x + texel.x); }
vec3 segmentAt(uint index) { return uintBitsToFloat(tyndallSegments[index].xyz); }

const float kOpaque = 16.0;
float opticalDepth(float passed) { return passed <= 1e-7 ? kOpaque : -log(passed); }
float passedAt(float depth) { return depth >= kOpaque ? 0.0 : exp(-depth); }


#if EXITS
uint next(uint at) { return exitLinks[at]; }
uvec4 segmentWithNext(uint at) { return uvec4(tyndallSegments[at].yxz, exitLinks[at]); }
void link(uint at, uint to) { exitLinks[at] = to; }
#else
uint next(uint at) { return tyndallSegments[at].w; }
uvec4 segmentWithNext(uint at) { return tyndallSegments[at]; }
void link(uint at, uint to) { tyndallSegments[at].w = to; }
#endif

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
