#version 430 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define TYNDALL_CURVE_NODES 12
#define TYNDALL_CURVE_PACKED 1
// AVSM reduce: each texel's curve from its segments in order, of entries and of exits: of all ends of segments, where the transmittance is
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 8)

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


vec2 tyndallCurve[TYNDALL_CURVE_ROOM];
int tyndallUsed = 0;
const float kTyndallUnused = 2.0; // depth of nodes in no use: behind the far plane

void tyndallEmptyCurve() {
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i] = vec2(kTyndallUnused, 1.0);
  tyndallUsed = 0;
}

float tyndallArea(vec2 a, vec2 b, vec2 c) { return abs((c.x - a.x) * (c.y - b.y) - (c.x - b.x) * (c.y - a.y)); }

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

void tyndallPadCurve() {
  vec2 last = vec2(1.0);
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) {
    if (i < tyndallUsed) last = tyndallCurve[i];
    else tyndallCurve[i] = last;
  }
}

#if TYNDALL_CURVE_PACKED
const int kTyndallNodesOfTexel = 4;

uvec4 tyndallTexelFrom(int first) {
  uvec4 texel;
  for (int i = 0; i < 4; ++i) {
    uvec2 bits = uvec2(round(clamp(tyndallCurve[first + i], 0.0, 1.0) * 65535.0));
    texel[i] = bits.x << 16u | bits.y;
  }
  return texel;
}

void tyndallTakeTexel(int first, uvec4 texel) {
  for (int i = 0; i < 4; ++i) tyndallCurve[first + i] = vec2(texel[i] >> 16u, texel[i] & 0xFFFFu) * (1.0 / 65535.0);
}
#else
const int kTyndallNodesOfTexel = 2;

uvec4 tyndallTexelFrom(int first) { return floatBitsToUint(vec4(tyndallCurve[first], tyndallCurve[first + 1])); }

void tyndallTakeTexel(int first, uvec4 texel) {
  tyndallCurve[first] = uintBitsToFloat(texel.xy);
  tyndallCurve[first + 1] = uintBitsToFloat(texel.zw);
}
#endif
const int kTyndallTexelsOfCurve = TYNDALL_CURVE_NODES / kTyndallNodesOfTexel;

void tyndallFindUsed() {
  tyndallUsed = TYNDALL_CURVE_NODES;
  for (int i = TYNDALL_CURVE_NODES - 1; i > 0; --i)
    if (tyndallUsed == i + 1 && tyndallCurve[i] == tyndallCurve[i - 1]) tyndallUsed = i;
  if (tyndallUsed == 1 && tyndallCurve[0] == vec2(1.0)) tyndallUsed = 0;
  for (int i = 0; i < TYNDALL_CURVE_ROOM; ++i) tyndallCurve[i].x = i < tyndallUsed ? tyndallCurve[i].x : kTyndallUnused;
}


#ifndef CURVES_ACCESS
#define CURVES_ACCESS writeonly
#endif
layout(rgba32ui, binding = 0) CURVES_ACCESS uniform uimage2DArray curveImage;

ivec3 placeOf(ivec3 texel, int i) { return ivec3(texel.xy, texel.z * kTyndallTexelsOfCurve + i); }

void storeCurve(ivec3 texel) {
  for (int i = 0; i < kTyndallTexelsOfCurve; ++i) imageStore(curveImage, placeOf(texel, i), tyndallTexelFrom(kTyndallNodesOfTexel * i));
}


struct End {
  uint at, next; // segment, and the next of the order
  float depth;
  float rate;    // of optical depth per depth, of a segment that has a length
  float jump;    // optical depth of one that has none
};

struct Walk {
  End entry, exit;
  float depth, opticalDepth;
  vec2 rate;  // of optical depth, and the rounding it lacks
  int inside; // segments
  float step; // at most so far at once
};

const float kNoEnd = 3e38;

End endAt(uint at, bool isExit) {
  if (at == kTyndallEnd) return End(at, at, kNoEnd, 0.0, 0.0);
  uvec4 segment = tyndallSegments[at];
  float entry = uintBitsToFloat(segment.x), exit = uintBitsToFloat(segment.y), own = opticalDepth(uintBitsToFloat(segment.z));
  uint next = isExit ? exitLinks[at] : segment.w;
  return End(at, next, isExit ? exit : entry, exit > entry ? own / (exit - entry) : 0.0, exit > entry ? 0.0 : own);
}

void addRate(inout Walk walk, float rate) {
  precise float sum = walk.rate.x + rate;
  precise float back = sum - walk.rate.x;
  precise float lost = (walk.rate.x - (sum - back)) + (rate - back);
  walk.rate = vec2(sum, walk.rate.y + lost);
}

Walk startWalk(uint list) {
  End entry = endAt(tyndallLists[list].head, false), exit = endAt(tyndallLists[list].exits, true);
  return Walk(entry, exit, entry.depth, 0.0, vec2(0.0), 0, 0.0);
}

void passEnd(inout Walk walk) {
  bool isExit = walk.exit.depth < walk.entry.depth;
  float rate = isExit ? walk.exit.rate : walk.entry.rate;
  addRate(walk, isExit ? -rate : rate);
  walk.opticalDepth += isExit ? 0.0 : walk.entry.jump;
  walk.inside += rate > 0.0 ? (isExit ? -1 : 1) : 0;
  walk.rate = walk.inside == 0 ? vec2(0.0) : walk.rate;
  End next = endAt(isExit ? walk.exit.next : walk.entry.next, isExit);
  if (isExit) walk.exit = next;
  else walk.entry = next;
  float sum = walk.rate.x + walk.rate.y;
  walk.step = sum > 0.0 ? max(0.25 / sum, (min(walk.entry.depth, walk.exit.depth) - walk.depth) / 8.0) : kNoEnd;
}

bool nextNode(inout Walk walk) {
  if (walk.depth >= min(walk.entry.depth, walk.exit.depth)) passEnd(walk);
  float end = min(walk.entry.depth, walk.exit.depth);
  if (end >= kNoEnd) return false;
  float rest = end - walk.depth, parts = ceil(min(rest / walk.step, 64.0)), step = parts > 1.0 ? rest / parts : rest;
  walk.opticalDepth += (walk.rate.x + walk.rate.y) * step;
  walk.depth = parts > 1.0 ? walk.depth + step : end;
  return true;
}

bool isOver(Walk walk) { return walk.opticalDepth >= kOpaque; }

vec2 nodeOf(Walk walk) { return vec2(walk.depth, passedAt(walk.opticalDepth)); }


vec2 integrals[TYNDALL_CURVE_ROOM];

vec2 integralsBetween(vec2 a, vec2 b) {
  float size = b.x - a.x, middle = sqrt(a.y * b.y);
  return vec2(a.y + 4.0 * middle + b.y, (2.0 * middle + b.y) * size) * (size / 6.0);
}

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

void fitValues() {
  float products[TYNDALL_CURVE_NODES]; // integrals of the transmittance times each node's hat function
  for (int i = 0; i < TYNDALL_CURVE_NODES; ++i) products[i] = 0.0;
  for (int i = 0; i + 1 < TYNDALL_CURVE_NODES; ++i) {
    float rising = integrals[i].y / max(lengthAt(i), 1e-12); // 1e-12: nothing is integrated over no length
    products[i] += integrals[i].x - rising;
    products[i + 1] += rising;
  }
  float slope[TYNDALL_CURVE_NODES], offset[TYNDALL_CURVE_NODES]; // value i = offset i - slope i * value i + 1
  slope[0] = 0.0;
  offset[0] = tyndallCurve[0].y;
  for (int i = 1; i < TYNDALL_CURVE_NODES; ++i) {
    float before = lengthAt(i - 1), behind = lengthAt(i), diagonal = (before + behind) / 3.0 - before / 6.0 * slope[i - 1];
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
