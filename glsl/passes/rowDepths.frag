// Row depths: the shadow map along each slice, one texel a step, four steps a fragment (Chen 2011, 3.2).
// Reads the slice table and the shadow map (glass map) of the views of a draw. Writes rowDepths: texels / 4 x rows, RGBA16 or
// RGBA32F, coded: four depths or, with the 2x2 filter or glass, the group's split (lib/split.glsl); then also rowShares,
// its average, and with ROW_HASHES, for temporal reuse, rowHashes, RG32F. What lies behind a row's end is not read.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"
#include "lib/shadowMap.glsl"
#include "lib/split.glsl"

layout(location = 0) out vec4 outDepths;

float coded(float depth) { return depth > 1e38 ? emptyRowCode : depth * rowCodeScale + rowCodeOffset; }

#if FILTER_BILINEAR || GLASS

layout(location = 1) out vec4 outShare;
#ifdef ROW_HASHES
layout(location = 2) out vec4 outHash; // of all that decides, to tell a change by: a group's split and share may hide it
#endif

// What decides at one sampling point: the texels around it (one of them, unfiltered), each dark behind `caster` and, with
// glass, tinted behind `pane`.
struct Point {
  vec4 caster, pane, weights;
  ivec4 corners; // low x, low y, high x, high y
};

ivec2 cornerOf(Point point, int i) { return ivec2(i % 2 == 0 ? point.corners.x : point.corners.z, i < 2 ? point.corners.y : point.corners.w); }

Point pointAt(vec2 p, int view) {
  ivec2 last = shadowViews[view].size - 1, origin = firstTexel(view);
  Point point;
#if FILTER_BILINEAR
  ivec2 cell = clamp(ivec2(floor(p - 0.5)), ivec2(-1), last), low = max(cell, ivec2(0)), high = min(cell + 1, last);
  vec2 f = clamp(p - 0.5 - vec2(cell), 0.0, 1.0), g = 1.0 - f;
  point.weights = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  point.caster = cornerDepths(cell + origin, view);
#else
  ivec2 low = clamp(ivec2(floor(p)), ivec2(0), last), high = low;
  point.weights = vec4(1.0, 0.0, 0.0, 0.0);
  point.caster = vec4(casterDepth(low + origin, view));
#endif
  for (int i = 0; i < 4; ++i) point.caster[i] = coded(point.caster[i]);
  point.corners = ivec4(low + origin, high + origin);
  point.pane = point.caster;
#if GLASS
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i)
    point.pane[i] = min(point.caster[i], coded(paneDepth(cornerOf(point, i), view)));
#if !FILTER_BILINEAR
  point.pane = point.pane.xxxx;
#endif
#endif
  return point;
}

float lowestOf(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float highestOf(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Adds a point to a group's split and share. Behind `middle` it is lit by some of its texels; those through panes follow.
void addPoint(Point point, float middle, inout vec4 split, inout Share share) {
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i) {
    float pane = point.pane[i], caster = point.caster[i];
#ifdef TINT_SUMS
    split.yz = vec2(pane < caster ? max(split.y, pane) : split.y, min(split.z, caster));
#else
    bool lit = pane > middle, dark = caster <= middle;
    split.y = max(split.y, lit ? split.y : dark ? caster : pane);
    split.z = min(split.z, lit ? pane : dark ? split.z : caster);
    share += Share(lit ? 0.25 * point.weights[i] : 0.0);
#endif
  }
}

#if GLASS && !defined(TINT_SUMS)

bool isTinted(Point point, float middle) {
  return any(lessThanEqual(point.pane, vec4(middle))) && any(greaterThan(point.caster, vec4(middle)));
}

void addTints(Point point, float middle, int view, inout Share share) {
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i)
    if (point.pane[i] <= middle && point.caster[i] > middle) share += 0.25 * point.weights[i] * paneTint(cornerOf(point, i), view);
}

#endif

#ifdef ROW_HASHES

void addBits(float value, inout uvec2 hash) {
  hash = (hash ^ floatBitsToUint(value)) * uvec2(16777619u, 2654435761u);
  hash ^= hash >> uvec2(15u, 13u);
}

void addHash(Point point, int view, inout uvec2 hash) {
  for (int i = 0; i < 1 + 3 * FILTER_BILINEAR; ++i) {
    addBits(point.caster[i], hash);
#if GLASS
    addBits(point.pane[i], hash);
    vec3 tint = paneTint(cornerOf(point, i), view);
    addBits(tint.r, hash);
    addBits(tint.g, hash);
    addBits(tint.b, hash);
#endif
  }
}

#endif

// Rounded outward where depths are stored in 16 bits: the texture's own rounding then changes nothing.
vec4 storedSplit(vec4 split) {
  vec4 scaled = split * rowCodeSteps;
  return rowCodeSteps > 0.0 ? vec4(floor(scaled.x), ceil(scaled.y), floor(scaled.z), ceil(scaled.w)) / rowCodeSteps : split;
}

void main() {
  int first = 4 * int(gl_FragCoord.x), view = viewOfRow(int(gl_FragCoord.y));
  vec4 row = rowLine(view, sliceOfRow(int(gl_FragCoord.y)));
  vec2 p = row.xy + row.zw * (float(first) + 0.5);
  Point a = pointAt(p, view), b = pointAt(p + row.zw, view);
  Point c = pointAt(p + 2.0 * row.zw, view), d = pointAt(p + 3.0 * row.zw, view);
  float lowest = lowestOf(min(min(a.pane, b.pane), min(c.pane, d.pane)));
  float highest = highestOf(max(max(a.caster, b.caster), max(c.caster, d.caster)));
  float middle = splitOf(view, lowest, highest);
  vec4 split = splitOfBounds(lowest, highest);
  Share share = Share(0.0);
  addPoint(a, middle, split, share);
  addPoint(b, middle, split, share);
  addPoint(c, middle, split, share);
  addPoint(d, middle, split, share);
#if GLASS && !defined(TINT_SUMS)
  // A loop, so that where no pane is near little is fetched.
  int points = isTinted(a, middle) || isTinted(b, middle) || isTinted(c, middle) || isTinted(d, middle) ? 4 : 0;
  for (int k = 0; k < points; ++k) {
    if (k == 1) a = b;
    if (k == 2) a = c;
    if (k == 3) a = d;
    addTints(a, middle, view, share);
  }
#endif
  outDepths = storedSplit(split);
  outShare = vec4(vec3(share), 0.0);
#ifdef ROW_HASHES
  uvec2 hash = uvec2(2166136261u, 374761393u);
  for (int k = 0; k < 4; ++k) addHash(pointAt(p + float(k) * row.zw, view), view, hash);
  outHash = vec4(vec2(hash >> 8u), 0.0, 0.0); // 24 bits each, exact in a float
#endif
}

#else

void main() {
  int first = 4 * int(gl_FragCoord.x), view = viewOfRow(int(gl_FragCoord.y));
  vec4 row = rowLine(view, sliceOfRow(int(gl_FragCoord.y)));
  ivec2 last = shadowViews[view].size - 1, origin = firstTexel(view);
  vec4 depths; // ESSL indexes no output
  for (int k = 0; k < 4; ++k) {
    vec2 p = row.xy + row.zw * (float(first + k) + 0.5);
    depths[k] = coded(casterDepth(clamp(ivec2(floor(p)), ivec2(0), last) + origin, view));
  }
  outDepths = depths;
}

#endif
