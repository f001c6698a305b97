// Row nodes: split and average of sixteen texels of each row, the finest level of the tree (level 2; lib/split.glsl).
// Reads the slice table, rowDepths and, with the 2x2 filter or glass, rowShares. Writes texels / 16 x rows: splits, RGBA,
// and averages; behind a row's end with bounds that add nothing to a coarser node's.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"
#include "lib/split.glsl"
uniform sampler2D rowDepths;

layout(location = 0) out vec4 outSplit;
layout(location = 1) out vec4 outMean;
#if GLASS
layout(location = 2) out vec4 outMoment;
#endif

void store(vec4 split, Average average) {
  outSplit = split;
  outMean = storedMean(average);
#if GLASS
  outMoment = storedMoment(average);
#endif
}

#if FILTER_BILINEAR || GLASS

uniform sampler2D rowShares;

void main() {
  int node = int(gl_FragCoord.x), row = int(gl_FragCoord.y), view = viewOfRow(row);
  Average average = Average(Share(0.0), Share(0.0));
  store(kNoSplit, average);
  if (16 * node >= rowTexels(view, sliceOfRow(row))) return;
  vec2 bounds = vec2(3.4e38, -3.4e38);
  for (int i = 0; i < 4; ++i) {
    vec2 one = texelFetch(rowDepths, ivec2(4 * node + i, row), 0).xw;
    bounds = vec2(min(bounds.x, one.x), max(bounds.y, one.y));
  }
  float middle = splitOf(view, bounds.x, bounds.y);
  vec4 split = splitOfBounds(bounds.x, bounds.y);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = ivec2(4 * node + i, row);
    vec3 share = texelFetch(rowShares, at, 0).rgb;
    addChild(texelFetch(rowDepths, at, 0), Average(Share(share), Share(0.0)), i, 4, middle, split, average);
  }
  store(split, average);
}

#else

void main() {
  int node = int(gl_FragCoord.x), row = int(gl_FragCoord.y), view = viewOfRow(row);
  Average average = Average(0.0, 0.0);
  store(kNoSplit, average);
  if (16 * node >= rowTexels(view, sliceOfRow(row))) return;
  vec4 depths[4];
  for (int i = 0; i < 4; ++i) depths[i] = texelFetch(rowDepths, ivec2(4 * node + i, row), 0);
  vec4 low = min(min(depths[0], depths[1]), min(depths[2], depths[3])), high = max(max(depths[0], depths[1]), max(depths[2], depths[3]));
  vec2 bounds = vec2(min(min(low.x, low.y), min(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)));
  float middle = splitOf(view, bounds.x, bounds.y);
  vec4 split = splitOfBounds(bounds.x, bounds.y);
  for (int i = 0; i < 16; ++i) {
    float depth = depths[i >> 2][i & 3];
    if (depth > middle) {
      split.z = min(split.z, depth);
      average.mean += 0.0625;
      average.moment += 0.0625 * ((2.0 * float(i) + 1.0) / 16.0 - 1.0);
    } else {
      split.y = max(split.y, depth);
    }
  }
  store(split, average);
}

#endif
