// Slice estimate: what the picture is expected to be off by for want of slices. ESTIMATE 1: root mean square as a part of the picture's mean
// light, and the share of the area that is off by more than the target. Reads sliceSpacing, sliceBlocks. Writes 1 x 1, RG32F. 2: as many fragments as
// stand for the first, 3: for the second of what 1 wrote (ESTIMATE_CODES).
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

layout(location = 0) out vec4 outEstimate;

#if ESTIMATE == 1

void main() {
  vec3 sum = vec3(0.0);
  for (int block = 0; block < candidateSlices / SLICE_BLOCK; ++block) {
    vec4 own = spacingOf(block);
    float error = errorWith(own, int(texelFetch(sliceBlocks, ivec2(block, 0), 0).g));
    sum += own.z * vec3(error, 1.0, error > sliceTarget * sliceTarget ? 1.0 : 0.0);
  }
  outEstimate = sum.y > 0.0 ? vec4(sqrt(sum.x / sum.y), sum.z / sum.y, 0.0, 0.0) : vec4(0.0);
}

#else

uniform sampler2D sliceEstimate;

void main() {
  vec2 estimate = texelFetch(sliceEstimate, ivec2(0), 0).rg;
  float code = ESTIMATE == 2 ? float(ESTIMATE_OCTAVE) * log2(max(estimate.r, 1e-30)) + float(ESTIMATE_LEAST) : float(ESTIMATE_CODES) * estimate.g;
  if (gl_FragCoord.x > code) discard;
  outEstimate = vec4(0.0);
}

#endif
