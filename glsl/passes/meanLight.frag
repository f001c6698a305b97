// Mean light: the picture's mean inscatter, for unwarp to tell which differences matter. MEAN_OF 1: sums over each slice's
// regular march samples, weighted by the area that a sample stands for, which grows with the distance from the epipole; 2: the mean of all.
// Reads the slice table and marched (1), or what 1 wrote (2). Writes slices x 1, RG32F: sum of the brightest channel times
// weight, sum of weights (1); 1 x 1, R32F: the mean (2).
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/slices.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"

layout(location = 0) out vec4 outMean;

#if MEAN_OF == 1

uniform sampler2D marched;

void main() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice);
  vec4 ends = sliceEnds(slice);
  vec2 sum = vec2(0.0);
  for (int index = 0; index < samples; index += 16) {
    vec2 p = samplePosition(ends, samples, float(index));
    float weight = length(epipole.z * p - epipole.xy);
    float light = brightestOf(radianceUnit(cameraRay(p)) * lightOf(texelFetch(marched, ivec2(slice, index >> 4), 0).rgb));
    sum += light >= 0.0 && light < 3e38 ? weight * vec2(light, 1.0) : vec2(0.0);
  }
  outMean = vec4(sum, 0.0, 0.0);
}

#else

uniform sampler2D sliceSums;

void main() {
  vec2 sum = vec2(0.0);
  for (int slice = 0; slice < sliceCount; ++slice) sum += texelFetch(sliceSums, ivec2(slice, 0), 0).rg;
  outMean = vec4(sum.y > 0.0 ? sum.x / sum.y : 0.0, 0.0, 0.0, 0.0);
}

#endif
