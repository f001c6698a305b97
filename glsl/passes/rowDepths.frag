// Row depths: the shadow map along each slice, one texel a step, four steps a fragment (Chen 2011, 3.2).
// Reads the slice table and the shadow map (glass map) of one view. Writes rowDepths: texels / 4 x slices, RGBA16 or
// RGBA32F, coded: four depths or, with the 2x2 filter or glass, the group's split (lib/split.glsl); then also rowShares,
// its average. What lies behind a row's end is not read.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/shadowMap.glsl"
#include "lib/split.glsl"

layout(location = 0) out vec4 outDepths;

float coded(float depth) { return depth > 1e38 ? rowCode.z : depth * rowCode.x + rowCode.y; }

#if FILTER_BILINEAR || GLASS

layout(location = 1) out vec4 outShare;

// What decides at one sampling point: the texels around it (one of them, unfiltered), each dark behind `caster` and, with
// glass, tinted behind `pane`.
struct Point {
  vec4 caster, pane, weights;
#if GLASS
  vec3 tints[4];
#endif
};

Point pointAt(vec2 p, int view) {
  ivec2 last = viewCounts.zw - 1;
  Point point;
#if FILTER_BILINEAR
  ivec2 cell = clamp(ivec2(floor(p - 0.5)), ivec2(-1), last), low = max(cell, ivec2(0)), high = min(cell + 1, last);
  vec2 f = clamp(p - 0.5 - vec2(cell), 0.0, 1.0), g = 1.0 - f;
  point.weights = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  point.caster = cornerDepths(cell, view);
#else
  ivec2 low = clamp(ivec2(floor(p)), ivec2(0), last), high = low;
  point.weights = vec4(1.0, 0.0, 0.0, 0.0);
  point.caster = vec4(casterDepth(low, view));
#endif
  for (int i = 0; i < 4; ++i) point.caster[i] = coded(point.caster[i]);
  point.pane = point.caster;
#if GLASS
  ivec2 corners[4] = ivec2[4](low, ivec2(high.x, low.y), ivec2(low.x, high.y), high);
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i) {
    point.pane[i] = min(point.caster[i], coded(paneDepth(corners[i], view)));
    point.tints[i] = paneTint(corners[i], view);
  }
#if !FILTER_BILINEAR
  point.pane = point.pane.xxxx;
  point.tints[1] = point.tints[2] = point.tints[3] = point.tints[0];
#endif
#endif
  return point;
}

float lowestOf(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float highestOf(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Adds a point to a group's split and share. Behind `middle` it is lit by some of its texels, and through some panes.
void addPoint(Point point, float middle, inout vec4 split, inout Share share) {
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i) {
    float pane = point.pane[i], caster = point.caster[i];
    bool lit = pane > middle, dark = caster <= middle;
    split.y = max(split.y, lit ? split.y : dark ? caster : pane);
    split.z = min(split.z, lit ? pane : dark ? split.z : caster);
#if GLASS
    share += 0.25 * point.weights[i] * (lit ? vec3(1.0) : dark ? vec3(0.0) : point.tints[i]);
#else
    share += 0.25 * point.weights[i] * (lit ? 1.0 : 0.0);
#endif
  }
}

// Rounded outward where depths are stored in 16 bits: the texture's own rounding then changes nothing.
vec4 storedSplit(vec4 split) {
  vec4 scaled = split * rowCode.w;
  return rowCode.w > 0.0 ? vec4(floor(scaled.x), ceil(scaled.y), floor(scaled.z), ceil(scaled.w)) / rowCode.w : split;
}

void main() {
  int slice = int(gl_FragCoord.y), first = 4 * int(gl_FragCoord.x), view = march.x;
  vec4 row = texelFetch(sliceTable, ivec2(slice, march.y), 0);
  vec2 p = row.xy + row.zw * (float(first) + 0.5);
  Point a = pointAt(p, view), b = pointAt(p + row.zw, view);
  Point c = pointAt(p + 2.0 * row.zw, view), d = pointAt(p + 3.0 * row.zw, view);
  float lowest = lowestOf(min(min(a.pane, b.pane), min(c.pane, d.pane)));
  float highest = highestOf(max(max(a.caster, b.caster), max(c.caster, d.caster)));
  float middle = splitOf(lowest, highest);
  vec4 split = vec4(lowest, lowest, highest, highest);
  Share share = Share(0.0);
  addPoint(a, middle, split, share);
  addPoint(b, middle, split, share);
  addPoint(c, middle, split, share);
  addPoint(d, middle, split, share);
  outDepths = storedSplit(split);
  outShare = vec4(vec3(share), 0.0);
}

#else

void main() {
  int slice = int(gl_FragCoord.y), first = 4 * int(gl_FragCoord.x), view = march.x;
  vec4 row = texelFetch(sliceTable, ivec2(slice, march.y), 0);
  ivec2 last = viewCounts.zw - 1;
  for (int k = 0; k < 4; ++k) {
    vec2 p = row.xy + row.zw * (float(first + k) + 0.5);
    outDepths[k] = coded(casterDepth(clamp(ivec2(floor(p)), ivec2(0), last), view));
  }
}

#endif
