#version 430 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define TYNDALL_CURVE_NODES 12
#define TYNDALL_CURVE_PACKED 1
// AVSM insert: each texel's curve from its list, segment by segment in the list's order, with as many nodes removed as came too many (Salvi
#define TYNDALL_CURVE_ROOM (TYNDALL_CURVE_NODES + 2)

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


float tyndallPassed(vec3 segment, float perDepth, float depth) {
  float inside = exp(perDepth * min(depth - segment.x, segment.y - segment.x));
  return depth <= segment.x ? 1.0 : depth >= segment.y ? segment.z : inside;
}

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
    if (tyndallUsed > TYNDALL_CURVE_NODES) {
      tyndallRemoveCheapest();
      tyndallCurve[TYNDALL_CURVE_ROOM - 1].x = kTyndallUnused;
    }
}


void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  tyndallEmptyCurve();
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) tyndallInsertSegment(segmentAt(at));
  tyndallPadCurve();
  storeCurve(texel);
}
