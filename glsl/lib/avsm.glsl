// What the passes over the captured lists of an adaptive volumetric shadow map share (Salvi et al. 2013, 3.1, 3.2): the lists, an invocation's
// texel, and curves of a fixed number of nodes with the removal of the cheapest.

#define TYNDALL_LISTS_MEMORY // no two invocations look at one list
#include "public/avsmCapture.glsl"

layout(std430, binding = 2) buffer ExitLinks {
  uint exitLinks[]; // as the links of the segments, in the order of exits
};
layout(local_size_x = 8, local_size_y = 8) in;

ivec3 ownTexel() { return ivec3(gl_GlobalInvocationID); }
bool isOutside(ivec3 texel) { return any(greaterThanEqual(texel, tyndallSize)); }
uint listOf(ivec3 texel) { return uint((texel.z * tyndallSize.y + texel.y) * tyndallSize.x + texel.x); }
vec3 segmentAt(uint index) { return uintBitsToFloat(tyndallSegments[index].xyz); }

// Optical depth of an opaque segment, and of all from which on nothing passes.
const float kOpaque = 16.0;
float opticalDepth(float passed) { return passed <= 1e-7 ? kOpaque : -log(passed); }
float passedAt(float depth) { return depth >= kOpaque ? 0.0 : exp(-depth); }
