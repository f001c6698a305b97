// Unwarp edges: as unwarp.frag, of the pixels whose samples show several surfaces; each sample takes from the slices what agrees with its
// own distance: of the nearest four samples or, as both sides of an edge are near, of those around them. Reads the slice table,
// epipolarInscatter and the depth of all samples. Writes edgeInscatter, image size, RGBA32F, the light of the samples that are served as
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

// Those around the pixel, or so many slices and samples further.
Four takeFour(vec2 p, float place, ivec2 beyond, float reach) {
  Four four;
  float low = floor(place) + float(beyond.x);
  ivec2 slices = neighbourSlices(place + float(beyond.x));
  takeTwo(slices.x, tent(place - low, reach), p, beyond.y, reach, four.texels[0], four.texels[1], four.weights.xy);
  takeTwo(slices.y, tent(place - low - 1.0, reach), p, beyond.y, reach, four.texels[2], four.texels[3], four.weights.zw);
  four.coordinates = vec4(storedCoordinate(four.texels[0]), storedCoordinate(four.texels[1]), storedCoordinate(four.texels[2]),
                          storedCoordinate(four.texels[3]));
  return four;
}

// Light of the ray up to an end, as unwarp.frag has it; of the nearest four also where they lead to the end.
vec4 lightTo(float coordinate, Four four, float allowed, bool nearest) {
  vec4 agreement = min(vec4(1.0), allowed / max(abs(four.coordinates - coordinate), vec4(1e-20)));
  agreement *= agreement;
  vec4 agreeing = four.weights * agreement * agreement;
  vec4 sum = vec4((four.texels * agreeing).rgb, dot(agreeing, vec4(1.0)));
  if (!nearest) return sum;
  float plainWeight = dot(four.weights, vec4(1.0));
  float apart = abs(dot(four.weights, four.coordinates - coordinate));
  float oneSurface = clamp(2.0 - apart / max(allowed * plainWeight, 1e-20), 0.0, 1.0);
  return mix(sum, vec4((four.texels * four.weights).rgb, plainWeight), oneSurface);
}

// The fours that have one of the nearest in a corner.
ivec2 beyondOf(int four) { return ivec2(four & 1, four >> 1) * 2 - 1; }

const float kNear = 0.125, kFar = 1.0;
const int kFours = 8;
void main() {
  vec2 position = unjittered(gl_FragCoord.xy);
  float place = sliceCoordinate(position), share = 1.0 / float(depthSampleCount), served = 0.0;
  Ray ray = cameraRay(position);
  Four nearest = takeFour(position, place, ivec2(0), 1.0);
  bool near = isNearLight(position);
  int left = 0;
  vec3 light = vec3(0.0), transmittance = vec3(0.0);
  for (int k = 0; k < depthSampleCount; ++k) {
    float end = sampleEndAt(k);
    vec4 own = lightTo(endCoordinate(ray, min(end, visibleEnd)), nearest, kNear * endThreshold, true);
    bool isDark = end <= 0.0, isDone = isDark || (isServed(own) && !near);
    transmittance += transmittanceTo(end) * share;
    light += isDone && !isDark ? own.rgb / own.w : vec3(0.0);
    served += isDone ? share : 0.0;
    left |= isDone ? 0 : 1 << k;
  }
  for (int i = 0; i < kFours && left != 0 && !near; ++i) {
    Four four = takeFour(position, place, beyondOf(i & 3), 2.0);
    float allowed = (i < 4 ? kNear : kFar) * endThreshold;
    for (int k = 0; k < depthSampleCount; ++k) {
      if ((left >> k & 1) == 0) continue;
      vec4 own = lightTo(endCoordinate(ray, min(sampleEndAt(k), visibleEnd)), four, allowed, false);
      if (!isServed(own)) continue;
      light += own.rgb / own.w;
      served += share;
      left &= ~(1 << k);
    }
  }
  outInscatter = vec4(served > 0.0 ? radianceOf(vec4(light * share, served), ray) * served : vec3(0.0), 0.0);
  outTransmittance = vec4(transmittance, 1.0);
  outRest = vec4(float(left), left == 0 ? 1.0 : 0.0, 0.0, 0.0);
}
