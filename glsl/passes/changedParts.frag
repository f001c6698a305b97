// Changed parts: of each row the stretches of 256 texels in which a texel is not what it was in the last frame, and between
// which depths that may matter to a ray: of the whole stretch, where a node's average may stand for it, else of the texels themselves.
// Reads the row depths of both frames and what tells a change (the same, or rowHashes). Writes texels / 256 x rows, RG32F: lowest,
// highest coded depth, the greater first if nothing has changed.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"

uniform sampler2D rowDepths;
uniform sampler2D lastRowDepths;
#ifdef ROW_HASHES
uniform sampler2D rowHashes;
uniform sampler2D lastRowHashes;
#endif
layout(location = 0) out vec4 outBounds;

vec2 boundsOf(vec4 group) {
#if FILTER_BILINEAR || GLASS
  return group.xw;
#else
  return vec2(min(min(group.x, group.y), min(group.z, group.w)), max(max(group.x, group.y), max(group.z, group.w)));
#endif
}

void main() {
  int row = int(gl_FragCoord.y), first = 64 * int(gl_FragCoord.x);
  int last = min(first + 64, rowTexels(viewOfRow(row), sliceOfRow(row)) / 4);
  bool changed = false;
  vec2 all = vec2(3.4e38, -3.4e38), some = all;
  for (int i = first; i < last; ++i) {
    vec4 now = texelFetch(rowDepths, ivec2(i, row), 0), before = texelFetch(lastRowDepths, ivec2(i, row), 0);
#ifdef ROW_HASHES
    bool differs = texelFetch(rowHashes, ivec2(i, row), 0).rg != texelFetch(lastRowHashes, ivec2(i, row), 0).rg;
#else
    bool differs = now != before;
#endif
    vec2 a = boundsOf(now), b = boundsOf(before), both = vec2(min(a.x, b.x), max(a.y, b.y));
    all = vec2(min(all.x, both.x), max(all.y, both.y));
    if (differs) some = vec2(min(some.x, both.x), max(some.y, both.y));
    changed = changed || differs;
  }
  outBounds = vec4(!changed ? vec2(1.0, 0.0) : averageThreshold > 0.0 ? all : some, 0.0, 0.0);
}
