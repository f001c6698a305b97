// Row nodes: bounds and split of sixteen texels of each row, the finest level of the tree (level 2; lib/split.glsl).
// Reads the slice table and rowDepths. Writes texels / 16 x slices: splits, RGBA, and averages, RG; behind a row's end
// with bounds that add nothing to a coarser node's.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/split.glsl"
uniform sampler2D rowDepths;

layout(location = 0) out vec4 outSplit;
layout(location = 1) out vec4 outAverage;

#if FILTER_BILINEAR || GLASS

void main() {
  int node = int(gl_FragCoord.x), slice = int(gl_FragCoord.y);
  outSplit = kNoSplit;
  outAverage = vec4(0.0);
  if (16 * node >= rowTexels(slice)) return;
  ivec2 at = ivec2(4 * node, slice);
  vec4 a = texelFetch(rowDepths, at, 0), b = texelFetch(rowDepths, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(rowDepths, at + ivec2(2, 0), 0), d = texelFetch(rowDepths, at + ivec2(3, 0), 0);
  vec4 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
  outSplit = vec4(low.x, kNoSplit.yz, high.y);
}

#else

void main() {
  int node = int(gl_FragCoord.x), slice = int(gl_FragCoord.y);
  outSplit = kNoSplit;
  outAverage = vec4(0.0);
  if (16 * node >= rowTexels(slice)) return;
  vec4 depths[4];
  for (int i = 0; i < 4; ++i) depths[i] = texelFetch(rowDepths, ivec2(4 * node + i, slice), 0);
  vec4 low = min(min(depths[0], depths[1]), min(depths[2], depths[3])), high = max(max(depths[0], depths[1]), max(depths[2], depths[3]));
  float lowest = min(min(low.x, low.y), min(low.z, low.w)), highest = max(max(high.x, high.y), max(high.z, high.w));
  float middle = splitOf(lowest, highest), before = lowest, behind = highest;
  vec2 average = vec2(0.0);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      float depth = depths[i][k], place = (2.0 * float(4 * i + k) + 1.0) / 16.0 - 1.0;
      bool lit = depth > middle;
      if (lit) behind = min(behind, depth);
      else before = max(before, depth);
      average += lit ? vec2(1.0, place) : vec2(0.0);
    }
  outSplit = vec4(lowest, before, behind, highest);
  outAverage = storedAverage(average / 16.0);
}

#endif
