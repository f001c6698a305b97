// Capture: records what an engine's own shaders put between a light and the scene, for an adaptive volumetric shadow map
// (Salvi et al. 2013; tyndall/avsm.h). Include it in a fragment or compute shader of #version 430 or later that draws
// smoke, hair or other blockers from the light's view, between Avsm::begin() and Avsm::resolve(), and call tyndallCapture().
// Define TYNDALL_LISTS_BINDING and, one more, TYNDALL_SEGMENTS_BINDING first if begin() was given another binding than 0.

#ifndef TYNDALL_LISTS_BINDING
#define TYNDALL_LISTS_BINDING 0
#define TYNDALL_SEGMENTS_BINDING 1
#endif

struct TyndallList {
  uint head, count, lock, exits; // the first segment, how many came, whether it is held, the first by exit once sorted
};

layout(std430, binding = TYNDALL_LISTS_BINDING) coherent buffer TyndallLists {
  uint tyndallRoom;  // segments that the memory holds beyond one for each list
  uint tyndallTaken; // of these; more than there is room for once it has overflown
  uint tyndallLost;  // segments that were not kept
  uint tyndallMost;  // segments that a list may hold
  ivec3 tyndallSize; // width, height and layers of the map
  uint tyndallFirsts; // lists that hold anything
  TyndallList tyndallLists[];
};

layout(std430, binding = TYNDALL_SEGMENTS_BINDING) coherent buffer TyndallSegments {
  uvec4 tyndallSegments[]; // entry, exit and transmittance as bits of floats, and the next segment of the list
};

const uint kTyndallEnd = 0xFFFFFFFFu;

// Keeps a segment for which there is no memory in place of the deepest of its list, if that lies deeper.
void tyndallReplaceDeepest(uint list, vec3 segment) {
  for (int attempt = 0; attempt < 1024; ++attempt) {
    if (atomicCompSwap(tyndallLists[list].lock, 0u, 1u) != 0u) continue;
    uint deepest = kTyndallEnd, at = tyndallLists[list].head;
    float depth = segment.x;
    for (uint i = 0u; i < tyndallMost && at != kTyndallEnd; ++i) {
      uvec4 other = tyndallSegments[at];
      if (uintBitsToFloat(other.x) > depth) {
        depth = uintBitsToFloat(other.x);
        deepest = at;
      }
      at = other.w;
    }
    if (deepest != kTyndallEnd) {
      tyndallSegments[deepest].x = floatBitsToUint(segment.x);
      tyndallSegments[deepest].y = floatBitsToUint(segment.y);
      tyndallSegments[deepest].z = floatBitsToUint(segment.z);
      memoryBarrierBuffer();
    }
    atomicExchange(tyndallLists[list].lock, 0u);
    break;
  }
  atomicAdd(tyndallLost, 1u);
}

// Records that between two depths of a texel only a part of the light passes, fading exponentially as in an even medium;
// at once where both depths are the same. texel: x and y of the map and its layer. entry, exit: linear depth in the light's view,
// 0 at its near and 1 at its far plane (avsmDepth() in tyndall/avsm.h); either may come first. transmittance: 0, for something
// opaque, to 1. What lies outside the map, or is not a number, is left out; what begins in front of the near plane
// dims the light from there on.
void tyndallCapture(ivec3 texel, float entry, float exit, float transmittance) {
  if (any(lessThan(texel, ivec3(0))) || any(greaterThanEqual(texel, tyndallSize))) return;
  float near = min(entry, exit), far = max(entry, exit), passed = clamp(transmittance, 0.0, 1.0);
  if (isnan(entry) || isnan(exit) || isnan(transmittance) || !(near <= 1.0) || !(passed < 1.0)) return;
  if (far > 1.0) passed = pow(passed, clamp((1.0 - near) / (far - near), 0.0, 1.0)); // of an even medium, what is in the map
  vec3 segment = vec3(max(near, 0.0), clamp(far, 0.0, 1.0), passed);

  uint list = uint((texel.z * tyndallSize.y + texel.y) * tyndallSize.x + texel.x), lists = uint(tyndallSize.x * tyndallSize.y * tyndallSize.z);
  uint rank = atomicAdd(tyndallLists[list].count, 1u), at = list; // the first segment of a list has a place of its own
  if (rank == 0u) atomicAdd(tyndallFirsts, 1u);
  if (rank > 0u && rank < tyndallMost) at = lists + atomicAdd(tyndallTaken, 1u);
  if (rank >= tyndallMost || at >= lists + tyndallRoom) {
    tyndallReplaceDeepest(list, segment);
    return;
  }
  tyndallSegments[at] = uvec4(floatBitsToUint(segment), kTyndallEnd);
  memoryBarrierBuffer(); // whoever finds it finds it whole
  tyndallSegments[at].w = atomicExchange(tyndallLists[list].head, at);
}
