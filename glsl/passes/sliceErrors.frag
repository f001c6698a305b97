// Slice errors: of a preview's slices, how far the regular march samples of each are from what unwarp.frag would make of its neighbours, and
// of those beyond them, if it were not there. Reads the slice table, sampleEnds, marched and meanLight, all of the preview. Writes slices x
// 1, RGBA32F: of the neighbours the sum of squares, as parts of the picture's mean light, times weights, the areas that samples stand for,
// and the sum of those; the same of those beyond.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/slices.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"
#include "lib/unwarp.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D marched;
uniform sampler2D meanLight;
layout(location = 0) out vec4 outErrors;

// A regular sample: where it is, its ray, its end as unwarp.frag compares it.
struct Sample {
  vec2 position;
  Ray ray;
  float coordinate;
};

Sample sampleAt(int slice, int index) {
  vec2 p = samplePosition(sliceEnds(slice), sliceSamples(slice), float(index));
  Ray ray = cameraRay(p);
  return Sample(p, ray, endCoordinate(ray, texelFetch(sampleEnds, ivec2(slice, index), 0).r));
}

// Sums over samples as unwarp.frag makes them: of those that agree with the end, and of all.
struct Sums {
  vec4 agreeing, plain;
  float plainWeight;
};

// Adds two regular samples of a slice.
void addSlice(int slice, Sample own, inout Sums sums) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  float y = clamp(dot(own.position, line.xy) + line.z, 0.0, line.w) / 16.0;
  int segment = min(int(y), max(int(line.w) / 16 - 1, 0));
  for (int k = 0; k < 2; ++k) {
    int index = 16 * (segment + k);
    if (float(index) > line.w) continue;
    float end = sampleAt(slice, index).coordinate, weight = 0.5 * max(1.0 - abs(y - float(segment + k)), 0.0);
    vec3 light = texelFetch(marched, ivec2(slice, segment + k), 0).rgb;
    sums.agreeing += weight * agreementOf(end, own.coordinate) * vec4(light, 1.0);
    sums.plain += weight * vec4(light, end);
    sums.plainWeight += weight;
  }
}

// At an open border the slice on the other side stands for one that is not there.
int neighbourOf(int slice, int apart) {
  bool isThere = slicesClosed != 0 || (slice + apart >= 0 && slice + apart < sliceCount);
  return wrapped(isThere ? slice + apart : slice - apart, sliceCount);
}

// The square of what a sample is off by, and how much it counts: not where no sample serves, since such pixels are marched by themselves.
vec2 errorOf(Sample own, vec3 light, int slice, int apart) {
  Sums sums = Sums(vec4(0.0), vec4(0.0), 0.0);
  addSlice(neighbourOf(slice, -apart), own, sums);
  addSlice(neighbourOf(slice, apart), own, sums);
  vec4 sum = lightOfSums(sums.agreeing, sums.plain, sums.plainWeight, own.coordinate);
  float area = length(epipole.z * own.position - epipole.xy);
  if (isNearLight(own.position) || !isServed(sum) || !(area < 1e18)) return vec2(0.0);
  float error = brightestOf(abs(radianceUnit(own.ray) * lightOf(sum.rgb / sum.w - light))) / max(texelFetch(meanLight, ivec2(0), 0).r, 1e-37);
  return error < 1e12 ? area * vec2(error * error, 1.0) : vec2(0.0);
}

void main() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice);
  outErrors = vec4(0.0);
  for (int index = 0; index < samples; index += 16) {
    Sample own = sampleAt(slice, index);
    vec3 light = texelFetch(marched, ivec2(slice, index / 16), 0).rgb;
    outErrors += vec4(errorOf(own, light, slice, 1), errorOf(own, light, slice, 2));
  }
}
