#version 430 core
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
#define TYNDALL_CURVE_NODES 8
#define TYNDALL_CURVE_PACKED 1
// Look-up: how much of a light reaches a depth, from the curves of an adaptive volumetric shadow map (Salvi et al. 2013, 3.3 and 4.2;

#ifndef TYNDALL_CURVE_EXPONENTIAL
#define TYNDALL_CURVE_EXPONENTIAL 0
#endif

#if TYNDALL_CURVE_PACKED
const int kTyndallNodesPerTexel = 4;
#else
const int kTyndallNodesPerTexel = 2;
#endif
const int kTyndallCurveLayers = TYNDALL_CURVE_NODES / kTyndallNodesPerTexel;

#if TYNDALL_CURVE_PACKED
void tyndallNodes(usampler2DArray curves, ivec3 texel, out vec4 depths, out vec4 passed) {
  uvec4 nodes = texelFetch(curves, texel, 0);
  depths = vec4(nodes >> 16u) * (1.0 / 65535.0);
  passed = vec4(nodes & 0xFFFFu) * (1.0 / 65535.0);
}
#else
void tyndallNodes(usampler2DArray curves, ivec3 texel, out vec2 depths, out vec2 passed) {
  vec4 nodes = uintBitsToFloat(texelFetch(curves, texel, 0));
  depths = nodes.xz;
  passed = nodes.yw;
}
#endif

float tyndallBetween(vec2 a, vec2 b, float depth) {
  float share = clamp((depth - a.x) / max(b.x - a.x, 1e-9), 0.0, 1.0); // 1e-9: two nodes at one depth are a step
#if TYNDALL_CURVE_EXPONENTIAL
  return a.y * pow(max(b.y, 1e-7) / max(a.y, 1e-7), share);
#else
  return mix(a.y, b.y, share);
#endif
}

float tyndallTransmittance(usampler2DArray curves, ivec3 texel, float depth) {
  vec2 before = vec2(0.0, 1.0);
  for (int i = 0; i < kTyndallCurveLayers; ++i) {
#if TYNDALL_CURVE_PACKED
    vec4 d, t;
#else
    vec2 d, t;
#endif
    tyndallNodes(curves, ivec3(texel.xy, texel.z * kTyndallCurveLayers + i), d, t);
    if (i == 0) {
      if (depth < d.x) return 1.0; // no dimming before the first node, which stands at 1
      before = vec2(d.x, t.x);
    }
#if TYNDALL_CURVE_PACKED
    if (i + 1 < kTyndallCurveLayers && depth >= d.w) {
      before = vec2(d.w, t.w);
      continue;
    }
    vec2 a = depth < d.x ? before : depth < d.y ? vec2(d.x, t.x) : depth < d.z ? vec2(d.y, t.y) : vec2(d.z, t.z);
    vec2 b = depth < d.x ? vec2(d.x, t.x) : depth < d.y ? vec2(d.y, t.y) : depth < d.z ? vec2(d.z, t.z) : vec2(d.w, t.w);
#else
    if (i + 1 < kTyndallCurveLayers && depth >= d.y) {
      before = vec2(d.y, t.y);
      continue;
    }
    vec2 a = depth < d.x ? before : vec2(d.x, t.x), b = depth < d.x ? vec2(d.x, t.x) : vec2(d.y, t.y);
#endif
    return depth >= b.x ? b.y : tyndallBetween(a, b, depth);
  }
  return 1.0;
}

float tyndallTransmittanceBilinear(usampler2DArray curves, vec2 place, int layer, float depth) {
  ivec2 size = textureSize(curves, 0).xy;
  vec2 at = place * vec2(size) - 0.5, f = fract(at);
  ivec2 low = clamp(ivec2(floor(at)), ivec2(0), size - 1), high = clamp(ivec2(floor(at)) + 1, ivec2(0), size - 1);
  vec2 bottom = vec2(tyndallTransmittance(curves, ivec3(low, layer), depth), tyndallTransmittance(curves, ivec3(high.x, low.y, layer), depth));
  vec2 top = vec2(tyndallTransmittance(curves, ivec3(low.x, high.y, layer), depth), tyndallTransmittance(curves, ivec3(high, layer), depth));
  return mix(mix(bottom.x, bottom.y, f.x), mix(top.x, top.y, f.x), f.y);
}
void main() { tyndallCapture(ivec3(gl_FragCoord.xy, 0), 0.25, 0.5, 0.5); }
