#version 450 core
#define TYNDALL_LISTS_BINDING 4
#define TYNDALL_SEGMENTS_BINDING 5
// Capture: records what an engine's own shaders put between a light and the scene, for an adaptive volumetric shadow map

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
void main() { tyndallCapture(ivec3(gl_FragCoord.xy, 0), 0.25, 0.5, 0.5); }
