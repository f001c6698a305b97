// Pair tree: bounds over the row of each slice and of the next in the same view, for rays that run between the two. Its levels lie behind
// one another, groups of four texels (level 1) first.
// Reads the slice table, rowDepths and rowTree. Writes pairTree: nodes x rows, RG.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"
uniform sampler2D rowDepths;
uniform sampler2D rowTree;

layout(location = 0) out vec4 outBounds;

// A node of a level that begins at `base` in rowTree.
vec2 nodeOf(int row, int level, int base, int node) {
  if (level > 1) return texelFetch(rowTree, ivec2(base + node, row), 0).xw;
  vec4 a = texelFetch(rowDepths, ivec2(node, row), 0);
#if FILTER_BILINEAR || GLASS
  return a.xw;
#else
  return vec2(min(min(a.x, a.y), min(a.z, a.w)), max(max(a.x, a.y), max(a.z, a.w)));
#endif
}

void main() {
  int at = int(gl_FragCoord.y), view = viewOfRow(at), slice = sliceOfRow(at);
  int other = neighbourSlices(float(slice) + 0.5).y, otherAt = rowOf(view, other);
  int node = int(gl_FragCoord.x), level = 1;
  while (node >= rowLength >> (2 * level) && level < treeLevels) {
    node -= rowLength >> (2 * level);
    ++level;
  }
  int base = int(gl_FragCoord.x) - node - rowLength / 4;
  // The nodes of the other row beside this one.
  vec4 row = rowLine(view, slice), beside = rowLine(view, other);
  vec2 along = beside.zw / dot(beside.zw, beside.zw), ends;
  ends.x = dot(row.xy + row.zw * float(node << (2 * level)) - beside.xy, along);
  ends.y = ends.x + dot(row.zw, along) * float(1 << (2 * level));
  ivec2 nodes = clamp(ivec2(floor(vec2(min(ends.x, ends.y), max(ends.x, ends.y)))), ivec2(0), ivec2(rowLength - 1)) >> (2 * level);
  vec2 a = nodeOf(at, level, base, node), b = nodeOf(otherAt, level, base, nodes.x), c = nodeOf(otherAt, level, base, nodes.y);
  vec2 bounds = vec2(min(a.x, min(b.x, c.x)), max(a.y, max(b.y, c.y)));
  // Rows in 16 bits may have been rounded to either side.
  if (rowCodeSteps > 0.0) bounds += vec2(bounds.x < emptyRowCode ? -1.0 : 0.0, 1.0) / rowCodeSteps;
  outBounds = vec4(bounds, 0.0, 0.0);
}
