// The captured lists as they are: the product of what all segments let through up to a depth.
#include "public/avsmCapture.glsl"

float transmittanceAt(ivec2 texel, float depth) {
  float sum = 0.0;
  uint at = tyndallLists[texel.y * tyndallSize.x + texel.x].head;
  while (at != kTyndallEnd) {
    vec3 segment = uintBitsToFloat(tyndallSegments[at].xyz);
    if (depth > segment.x || (depth == segment.x && segment.y == segment.x))
      sum += -log(max(segment.z, 1e-7)) * (segment.y > segment.x ? min((depth - segment.x) / (segment.y - segment.x), 1.0) : 1.0);
    at = tyndallSegments[at].w;
  }
  return exp(-sum);
}
