// Row depths: the shadow map along each slice, one texel a step, four steps a fragment (Chen 2011, 3.2).
// Reads the slice table and the shadow map (glass map) of one view. Writes rowDepths: texels / 4 x slices, RGBA16 or
// RGBA32F, coded depths; what lies behind a row's end is not read.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/shadowMap.glsl"

layout(location = 0) out vec4 outDepths;

// What decides in a texel of the row: bounds of all depths that a look-up there compares with.
vec2 boundsAt(vec2 p, int view) {
  ivec2 last = viewCounts.zw - 1;
#if FILTER_BILINEAR
  ivec2 cell = clamp(ivec2(floor(p - 0.5)), ivec2(-1), last);
  vec4 depths = cornerDepths(cell, view);
  vec4 lows = depths;
#if GLASS
  lows = min(lows, cornerPanes(cell, view));
#endif
  return vec2(min(min(lows.x, lows.y), min(lows.z, lows.w)), max(max(depths.x, depths.y), max(depths.z, depths.w)));
#else
  ivec2 texel = clamp(ivec2(floor(p)), ivec2(0), last);
  float depth = casterDepth(texel, view);
#if GLASS
  return vec2(min(depth, paneDepth(texel, view)), depth);
#else
  return vec2(depth);
#endif
#endif
}

// Coded bounds, rounded outward where they are stored in 16 bit: the texture's own rounding then changes nothing.
vec2 codedBounds(vec2 p, int view) {
  vec2 bounds = boundsAt(p, view);
  bounds = mix(bounds * rowCode.x + rowCode.y, rowCode.zz, greaterThan(bounds, vec2(1e38)));
#if FILTER_BILINEAR || GLASS
  if (rowCode.w > 0.0) bounds = vec2(floor(bounds.x * rowCode.w), ceil(bounds.y * rowCode.w)) / rowCode.w;
#endif
  return bounds;
}

void main() {
  int slice = int(gl_FragCoord.y), first = 4 * int(gl_FragCoord.x), view = march.x;
  vec4 row = texelFetch(sliceTable, ivec2(slice, march.y), 0);
  vec2 p = row.xy + row.zw * (float(first) + 0.5);
  vec2 a = codedBounds(p, view), b = codedBounds(p + row.zw, view);
  vec2 c = codedBounds(p + 2.0 * row.zw, view), d = codedBounds(p + 3.0 * row.zw, view);
#if FILTER_BILINEAR || GLASS
  outDepths = vec4(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)), 0.0, 0.0);
#else
  outDepths = vec4(a.x, b.x, c.x, d.x);
#endif
}
