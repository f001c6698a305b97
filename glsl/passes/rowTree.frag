// Row tree: all levels of the tree behind one another, each gathered from the finest (Chen 2011, 3.3; lib/split.glsl).
// Reads what rowNodes.frag wrote. Writes rowTree, RGBA, and averages: nodes x rows (layout: lib/tree.glsl).
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"
#include "lib/split.glsl"
uniform sampler2D rowNodes;
uniform sampler2D rowNodeMeans;
#if GLASS
uniform sampler2D rowNodeMoments;
#endif

layout(location = 0) out vec4 outSplit;
layout(location = 1) out vec4 outMean;
#if GLASS
layout(location = 2) out vec4 outMoment;
#endif

Average averageAt(ivec2 at) {
#if GLASS
  return averageOf(texelFetch(rowNodeMeans, at, 0), texelFetch(rowNodeMoments, at, 0));
#else
  return averageOf(texelFetch(rowNodeMeans, at, 0));
#endif
}

void main() {
  int row = int(gl_FragCoord.y), view = viewOfRow(row), node = int(gl_FragCoord.x), level = 2;
  while (node >= rowLength >> (2 * level) && level < treeLevels) {
    node -= rowLength >> (2 * level);
    ++level;
  }
  int count = 1 << (2 * (level - 2)), first = node * count;
  vec4 split = texelFetch(rowNodes, ivec2(first, row), 0);
  Average average = averageAt(ivec2(first, row));
  if (count > 1) {
    vec2 bounds = vec2(3.4e38, -3.4e38);
    for (int i = 0; i < count; ++i) {
      vec2 one = texelFetch(rowNodes, ivec2(first + i, row), 0).xw;
      bounds = vec2(min(bounds.x, one.x), max(bounds.y, one.y));
    }
    float middle = splitOf(view, bounds.x, bounds.y);
    split = splitOfBounds(bounds.x, bounds.y);
    average = Average(Share(0.0), Share(0.0));
    for (int i = 0; i < count; ++i) {
      ivec2 at = ivec2(first + i, row);
      addChild(texelFetch(rowNodes, at, 0), averageAt(at), i, count, middle, split, average);
    }
  }
  outSplit = split;
  outMean = storedMean(average);
#if GLASS
  outMoment = storedMoment(average);
#endif
}
