// Sample ends: the length of the camera ray at every sample of every slice, from the nearest pixel's depth.
// Reads the slice table and the scene depth. Writes sampleEnds: slices x samples, R32F, world units, -1 beyond a slice's
// last sample.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

layout(location = 0) out vec4 outEnd;

void main() {
  int slice = int(gl_FragCoord.x), index = int(gl_FragCoord.y), samples = sliceSamples(slice);
  vec2 p = samplePosition(sliceEnds(slice), samples, index);
  ivec2 pixel = clamp(ivec2(p), ivec2(0), counts.zw - 1);
  float end = min(max(rayEnd(vec2(pixel) + 0.5, depthAt(pixel, 0)), 0.0), extinction.w);
  outEnd = vec4(index < samples ? end : -1.0, 0.0, 0.0, 0.0);
}
