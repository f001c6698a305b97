// Mask: the pixels that a change touches: their own depth (COMPARES_DEPTH 1) or a sample that serves them. Discards the
// others; writes the stencil only. Reads the slice table, changedSegments, changedSlices, sampleEnds, the scene depth and the last frame's.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

uniform sampler2D changedSegments;
uniform sampler2D changedSlices;
uniform sampler2D sampleEnds;
#if COMPARES_DEPTH
uniform sampler2D lastDepth;
#endif

// True if one of the two samples next to a position on a slice has changed. A ray that ends behind both, or beside the slice's
// samples, is marched by itself: then any change of the row counts.
bool isChanged(int slice, vec2 p, float end) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  float y = dot(p, line.xy) + line.z;
  int low = int(clamp(y, 0.0, line.w)), high = min(low + 1, int(line.w));
  bool segments = texelFetch(changedSegments, ivec2(slice, low >> 4), 0).r > 0.0 || texelFetch(changedSegments, ivec2(slice, high >> 4), 0).r > 0.0;
  float farther = max(texelFetch(sampleEnds, ivec2(slice, low), 0).r, texelFetch(sampleEnds, ivec2(slice, high), 0).r);
  bool alone = min(end, extinction.w) > 1.0001 * farther || y < 0.0 || y > line.w;
  return segments || (alone && texelFetch(changedSlices, ivec2(slice, 0), 0).a > 0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), slices = neighbourSlices(sliceCoordinate(gl_FragCoord.xy));
  float depth = depthAt(pixel, 0), end = max(rayEnd(gl_FragCoord.xy, depth), 0.0);
  bool changed = isChanged(slices.x, gl_FragCoord.xy, end) || isChanged(slices.y, gl_FragCoord.xy, end);
#if COMPARES_DEPTH
  changed = changed || floatBitsToInt(depth) != floatBitsToInt(texelFetch(lastDepth, pixel, 0).r);
#endif
  if (!changed) discard;
}
