// Unwarp edges: as unwarp.frag, of the pixels whose samples show several surfaces; each sample takes from the slices what agrees with its
// own distance: of the nearest four samples or, as both sides of an edge are near, of those around them. Reads the slice table,
// sliceBlocks, epipolarInscatter and the depth of all samples. Writes edgeInscatter, image size, RGBA32F, the light of the samples that are served as
// a part of the pixel's; edgeTransmittance, the same, the mean; edgeRest, RG32F: a mask of the others, and 0, or 1 if there are none.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/depthSamples.glsl"
#include "lib/slices.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"
#include "lib/unwarp.glsl"

uniform sampler2D epipolarInscatter;
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
layout(location = 2) out vec4 outRest;

// Two samples each of two slices: what they hold, and how much each counts by its place.
struct Four {
  mat4 texels;
  vec4 coordinates, weights;
};

// The tent over `reach` slices, or samples, to each side.
float tent(float distance, float reach) { return max(reach - abs(distance), 0.0) / (reach * reach); }

void takeTwo(int slice, float weight, vec2 p, int beyond, float reach, out vec4 low, out vec4 high, out vec2 weights) {
  vec4 line = texelFetch(sliceTable, ivec2(slice, 1), 0);
  float y = dot(p, line.xy) + line.z, past = max(max(-y, y - line.w), 0.0), last = line.w;
  bool reaches = past * past <= dot(line.xy, line.xy); // to the pixel, or nearly
  y = clamp(y, 0.0, last);
  float first = max(min(floor(y), last - 1.0), 0.0) + float(beyond);
  vec2 index = vec2(first, first + 1.0);
  low = texelFetch(epipolarInscatter, ivec2(slice, int(clamp(index.x, 0.0, last))), 0);
  high = texelFetch(epipolarInscatter, ivec2(slice, int(clamp(index.y, 0.0, last))), 0);
  weights.x = reaches && index.x >= 0.0 ? weight * tent(y - index.x, reach) : 0.0;
  weights.y = reaches && index.y <= last ? weight * tent(y - index.y, reach) : 0.0;
}

// Those around the pixel, or one slice and so many samples further.
Four takeFour(vec2 p, SlicePair pair, ivec2 beyond, float reach) {
  Four four;
  ivec2 slices = pair.columns;
  if (beyond.x < 0) slices = ivec2(wrapped(slices.x - 1, drawnColumns()), slices.x);
  if (beyond.x > 0) slices = ivec2(slices.y, wrapped(slices.y + 1, drawnColumns()));
  float fromFirst = pair.share - float(beyond.x); // in slices, as if those were as far apart
  takeTwo(slices.x, tent(fromFirst, reach), p, beyond.y, reach, four.texels[0], four.texels[1], four.weights.xy);
  takeTwo(slices.y, tent(fromFirst - 1.0, reach), p, beyond.y, reach, four.texels[2], four.texels[3], four.weights.zw);
  four.coordinates = vec4(storedCoordinate(four.texels[0]), storedCoordinate(four.texels[1]), storedCoordinate(four.texels[2]),
                          storedCoordinate(four.texels[3]));
  return four;
}

vec4 power4(vec4 x) { return x * x * x * x; }

// By how far four samples' ends are from a sample's of the pixel: those that end nearest count for most, as at an edge that is no break
// light may differ, too.
vec4 agreementOf(Four four, float coordinate, float allowed) {
  return four.weights * power4(min(vec4(1.0), allowed / max(abs(four.coordinates - coordinate), vec4(1e-20))));
}

vec4 weigh(Four four, vec4 weights) { return vec4((four.texels * weights).rgb, dot(weights, vec4(1.0))); }

// Light of the ray up to an end, from the nearest four: those that agree or, where they lead to the end, all.
vec4 nearestLight(Four four, float coordinate) {
  float weight = dot(four.weights, vec4(1.0)), allowed = 0.125 * endThreshold;
  float apart = abs(dot(four.weights, four.coordinates - coordinate));
  float oneSurface = clamp(2.0 - apart / max(allowed * weight, 1e-20), 0.0, 1.0);
  return weigh(four, mix(agreementOf(four, coordinate, allowed), four.weights, oneSurface));
}

// The same from all fours that have one of the nearest in a corner; nothing if none agrees as well as unwarp.frag asks for.
vec4 lightAround(vec2 position, SlicePair pair, float coordinate) {
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int i = 0; i < 4; ++i) {
    Four four = takeFour(position, pair, ivec2(i & 1, i >> 1) * 2 - 1, 2.0);
    sum += weigh(four, agreementOf(four, coordinate, 0.125 * endThreshold));
    weight += dot(agreementOf(four, coordinate, endThreshold), vec4(1.0));
  }
  return weight >= leastWeight && sum.w > 0.0 ? sum / sum.w : vec4(0.0);
}

int lowestOf(int samples) { return int(log2(float(samples & -samples)) + 0.5); }

void main() {
  vec2 position = unjittered(gl_FragCoord.xy);
  float share = 1.0 / float(depthSampleCount), served = 0.0;
  SlicePair pair = slicesAround(sliceCoordinate(position));
  Ray ray = cameraRay(position);
  Four nearest = takeFour(position, pair, ivec2(0), 1.0);
  int left = 0, rest = 0;
  vec3 light = vec3(0.0), transmittance = vec3(0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = sampleEndAt(k);
    vec4 own = nearestLight(nearest, endCoordinate(ray, min(end, visibleEnd)));
    bool isDark = end <= 0.0, isDone = isDark || isServed(own);
    transmittance += transmittanceTo(ray, end) * share;
    light += isDone && !isDark ? own.rgb / own.w : vec3(0.0);
    served += isDone ? share : 0.0;
    left |= isDone ? 0 : 1 << k;
    rest |= isDark ? 0 : 1 << k;
  }
  if (isNearLight(position)) {
    light = vec3(0.0);
    served = 0.0;
    left = 0;
  } else {
    rest = 0;
  }
  while (left != 0) {
    int sampleLeft = lowestOf(left);
    vec4 own = lightAround(position, pair, endCoordinate(ray, min(sampleEndAt(sampleLeft), visibleEnd)));
    light += own.rgb;
    served += own.w * share;
    rest |= own.w > 0.0 ? 0 : 1 << sampleLeft;
    left &= left - 1;
  }
  outInscatter = vec4(served > 0.0 ? radianceOf(vec4(light * share, served), ray) * served : vec3(0.0), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
  outRest = vec4(float(rest), rest == 0 ? 1.0 : 0.0, 0.0, 0.0);
}
