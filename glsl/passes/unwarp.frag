// Unwarp: from slices to pixels, bilinear over two slices and two samples each, each sample weighted by how well its
// distance agrees with the pixel's (Yusov 2013, "Transformation from epipolar to rectangular coordinates"). A pixel that no
// sample serves is discarded, so that its stencil stays for the fix-up. Reads the slice table, sampleEnds,
// epipolarInscatter and the scene depth. Writes inscatter and transmittance as exact.frag does.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"
#define Light vec3
#include "lib/stored.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D epipolarInscatter;

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void addSlice(int slice, float sliceWeight, vec2 p, float inverseEnd, inout vec4 sum) {
  vec4 ends = sliceEnds(slice);
  vec2 shape = texelFetch(sliceTable, ivec2(slice, 1), 0).xy; // samples, length
  float y = clamp(dot(p - ends.xy, ends.zw - ends.xy) / max(shape.y * shape.y, 1e-12), 0.0, 1.0) * max(shape.x - 1.0, 0.0);
  int low = min(int(y), max(int(shape.x) - 2, 0));
  float f = y - float(low);
  for (int k = 0; k < 2; ++k) {
    ivec2 at = ivec2(slice, low + k);
    float end = texelFetch(sampleEnds, at, 0).r;
    // How far the inverse distances differ, as a part of the pixel's own.
    float change = abs(1.0 / max(end, 1e-30) - inverseEnd) / inverseEnd;
    float agreement = min(1.0, thresholds.x / max(change, 1e-20));
    float weight = end < 0.0 ? 0.0 : sliceWeight * (k == 0 ? 1.0 - f : f) * agreement * agreement * agreement * agreement;
    sum += weight * vec4(texelFetch(epipolarInscatter, at, 0).rgb, 1.0);
  }
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(pixel, 0)), 0.0);
  float coordinate = sliceCoordinate(gl_FragCoord.xy);
  ivec2 slices = neighbourSlices(coordinate);
  float f = coordinate - floor(coordinate);
  float inverseEnd = 1.0 / max(min(end, extinction.w), 1e-30);
  vec4 sum = vec4(0.0);
  addSlice(slices.x, 1.0 - f, gl_FragCoord.xy, inverseEnd, sum);
  addSlice(slices.y, f, gl_FragCoord.xy, inverseEnd, sum);
  if (!(sum.w >= thresholds.y)) discard;
  outInscatter = vec4(min(lightFromStored(sum.rgb / sum.w), limits.xxx), 0.0);
  outTransmittance = vec4(exp(-extinction.rgb * end), 1.0);
}
