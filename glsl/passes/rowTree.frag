// Row tree: all levels of the min/max tree behind one another, each gathered from the finest (Chen 2011, 3.3).
// Reads rowNodes: texels / 16 x slices, RG. Writes rowTree: nodes x slices, RG (layout: lib/tree.glsl).
#include "shared.glsl"
uniform sampler2D rowNodes;

layout(location = 0) out vec4 outBounds;

void main() {
  int slice = int(gl_FragCoord.y), node = int(gl_FragCoord.x), level = 2;
  while (node >= grid.z >> (2 * level) && level < grid.w) {
    node -= grid.z >> (2 * level);
    ++level;
  }
  int count = 1 << (2 * (level - 2));
  vec2 bounds = vec2(3.4e38, -3.4e38);
  for (int i = 0; i < count; ++i) {
    vec2 one = texelFetch(rowNodes, ivec2(node * count + i, slice), 0).rg;
    bounds = vec2(min(bounds.x, one.x), max(bounds.y, one.y));
  }
  outBounds = vec4(bounds, 0.0, 0.0);
}
