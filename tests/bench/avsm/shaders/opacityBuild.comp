// Opacity shadow map (Kim and Neumann 2001): optical depth from the light up to each of SLICES depths, evenly over the map's range. Reads the
// lists. Writes slices (R32F, a layer each).
#include "lib/avsm.glsl"
#include "segments.glsl"

layout(r32f, binding = 0) uniform writeonly image3D slices;

void main() {
  ivec3 texel = ownTexel();
  if (isOutside(texel)) return;
  float sums[SLICES];
  for (int i = 0; i < SLICES; ++i) sums[i] = 0.0;
  for (uint at = tyndallLists[listOf(texel)].head; at != kTyndallEnd; at = tyndallSegments[at].w) {
    vec3 segment = segmentAt(at);
    float own = absorbance(segment.z), perDepth = 1.0 / max(segment.y - segment.x, 1e-9); // 1e-9: at once where both are the same
    for (int i = 0; i < SLICES; ++i) sums[i] += own * clamp((float(i + 1) / float(SLICES) - segment.x) * perDepth, 0.0, 1.0);
  }
  for (int i = 0; i < SLICES; ++i) imageStore(slices, ivec3(texel.xy, i), vec4(sums[i]));
}
