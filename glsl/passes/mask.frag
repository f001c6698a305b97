// Mask: the pixels that a change touches: their own depth (COMPARES_DEPTH 1) or a slice that serves them. Discards the
// others; writes the stencil only. Reads changedSlices, the scene depth and the last frame's.
#include "shared.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

uniform sampler2D changedSlices;
#if COMPARES_DEPTH
uniform sampler2D lastDepth;
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), slices = neighbourSlices(sliceCoordinate(gl_FragCoord.xy));
  bool changed = texelFetch(changedSlices, ivec2(slices.x, 0), 0).r > 0.0 || texelFetch(changedSlices, ivec2(slices.y, 0), 0).r > 0.0;
#if COMPARES_DEPTH
  changed = changed || floatBitsToInt(depthAt(pixel, 0)) != floatBitsToInt(texelFetch(lastDepth, pixel, 0).r);
#endif
  if (!changed) discard;
}
