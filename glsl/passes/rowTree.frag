// Row tree: all levels of the tree behind one another, each gathered from the finest (Chen 2011, 3.3; lib/split.glsl).
// Reads rowNodes and rowNodeAverages: texels / 16 x slices. Writes rowTree, RGBA, and rowAverages, RG: nodes x slices
// (layout: lib/tree.glsl).
#include "shared.glsl"
#include "lib/split.glsl"
uniform sampler2D rowNodes;
uniform sampler2D rowNodeAverages;

layout(location = 0) out vec4 outSplit;
layout(location = 1) out vec4 outAverage;

void main() {
  int slice = int(gl_FragCoord.y), node = int(gl_FragCoord.x), level = 2;
  while (node >= grid.z >> (2 * level) && level < grid.w) {
    node -= grid.z >> (2 * level);
    ++level;
  }
  int count = 1 << (2 * (level - 2)), first = node * count;
  if (count == 1) {
    outSplit = texelFetch(rowNodes, ivec2(first, slice), 0);
    outAverage = texelFetch(rowNodeAverages, ivec2(first, slice), 0);
    return;
  }
  vec2 bounds = vec2(3.4e38, -3.4e38);
  for (int i = 0; i < count; ++i) {
    vec2 one = texelFetch(rowNodes, ivec2(first + i, slice), 0).xw;
    bounds = vec2(min(bounds.x, one.x), max(bounds.y, one.y));
  }
  float middle = splitOf(bounds.x, bounds.y), before = bounds.x, behind = bounds.y;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < count; ++i) {
    vec4 split = texelFetch(rowNodes, ivec2(first + i, slice), 0);
    vec2 average = vec2(0.0);
    if (split.x > middle) { // all behind
      behind = min(behind, split.x);
      average.x = split.x <= split.w ? 1.0 : 0.0;
    } else if (split.w <= middle) { // all before
      before = max(before, split.w);
    } else {
      before = max(before, split.y);
      behind = min(behind, split.z);
      average = averageOf(texelFetch(rowNodeAverages, ivec2(first + i, slice), 0));
    }
    float place = (2.0 * float(i) + 1.0) / float(count) - 1.0;
    sum += vec2(average.x, average.x * place + average.y / float(count)) / float(count);
  }
  outSplit = vec4(bounds.x, before, behind, bounds.y);
  outAverage = storedAverage(sum);
}
