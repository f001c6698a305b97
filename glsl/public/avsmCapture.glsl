// Capture: records what an engine's own shaders put between a light and the scene, for an adaptive volumetric shadow map
// (Salvi et al. 2013; tyndall/avsm.h). Include it in a fragment or compute shader of #version 430 or later that draws
// smoke, hair or other blockers from the light's view, between Avsm::begin() and Avsm::resolve(), and call tyndallCapture().
// Define TYNDALL_LISTS_BINDING and, one more, TYNDALL_SEGMENTS_BINDING first if begin() was given another binding than 0.

#ifndef TYNDALL_LISTS_BINDING
#define TYNDALL_LISTS_BINDING 0
#define TYNDALL_SEGMENTS_BINDING 1
#endif

#ifndef TYNDALL_LISTS_MEMORY
#define TYNDALL_LISTS_MEMORY coherent volatile // invocations look at each other's segments
#endif

#include "lib/avsmSegment.glsl"

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

// Bits of floats that are not negative are in their order.
bool tyndallIsDeeper(uvec3 a, uvec3 b) { return a.x != b.x ? a.x > b.x : a.y != b.y ? a.y > b.y : a.z > b.z; }

// Takes a segment for which there is no memory down its list, and there changes places with each that lies deeper, so that the deepest of all
// is lost. One segment is held at a time, and only while it is exchanged; who cannot have it after some attempts goes on without.
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

// Records that between two depths of a texel only a part of the light passes, fading exponentially as in an even medium;
// at once where both depths are the same. texel: x and y of the map and its layer. entry, exit: linear depth in the light's view,
// 0 at its near and 1 at its far plane (avsmDepth() in tyndall/avsm.h); either may come first. transmittance: 0, for something
// opaque, to 1. What lies outside the map, or is not a finite number, is left out; what begins in front of the near plane
// dims the light from there on.
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
