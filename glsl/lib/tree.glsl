// Visibility along a slice's row, with a min/max tree over it (Chen 2011, 3.3; Yusov 2013). The row holds the shadow map's
// texels along the slice, one per step; all rays of the slice run along it, each with its own linear depth.
//
// rowDepths: texels / 4 x rows (lib/rows.glsl), RGBA: four depths, or, where more than the texels themselves decides (2x2 filter, glass),
// the group's split and, in rowShares, its mean. rowTree: nodes x rows, RGBA: splits (lib/split.glsl) of 16 texels (level 2), then of 64, 256, ...
// (levels 3, 4, ...). Level l of a row of T texels holds T / 4^l nodes, behind those of the levels below. Depths grow away
// from the light and are coded (rowCodeScale): 16-bit where the light's depth is linear, else float.

// For the debug view of the visits: nodes, groups of texels and single texels that the ray looked at.
#ifdef COUNT_VISITS
int visits = 0;
#define VISIT ++visits;
#else
#define VISIT
#endif

#if SHADOW_VIEWS > 0

#include "lib/rows.glsl"
#include "lib/split.glsl"

uniform sampler2D rowDepths;
uniform sampler2D rowTree;
uniform sampler2D rowMeans; // averages, as split.glsl stores them
#if GLASS
uniform sampler2D rowMoments;
#endif

// A ray on its row: u runs from 0 to 1 over the segment, the row index at u is begin + u * extent.
struct RowLine {
  float begin, inverse; // inverse: 1 / extent, or 0 if the ray does not move along the row
  float depth, slope;   // coded
  int row;  // where row textures hold it
  int last; // index of the last texel
#ifdef TINT_SUMS
  bool tintSums;  // the ray may use them
#endif
  int evenLevel;  // coarsest level at which a line stands for the airlight over a node
};

const int kMostEven = 4; // changedParts.frag counts on nodes of 256 texels at most to be taken by their averages

struct RowWalk {
  int index;
  float u;
};

// Coded depth of the ray; nothing lies behind what a texel without a caster holds.
float rowDepth(RowLine line, float u) { return min(line.depth + line.slope * u, emptyRowCode); }

void startRow(Airlight light, ViewSegment segment, int slice, out RowLine line, out RowWalk walk) {
  vec4 row = rowLine(segment.view, slice);
  line.row = rowOf(segment.view, slice);
#if CURVES && defined(ROW_CURVES)
  startCurves(segment, isAlongX(row), (isAlongX(row) ? row.z : row.w) < 0.0, line.row);
#endif
  int highest = rowLast(segment.view, slice);
  float scale = 1.0 / dot(row.zw, row.zw);
  line.begin = dot(segment.p0.xy - row.xy, row.zw) * scale;
  float end = dot(segment.p1.xy - row.xy, row.zw) * scale;
  walk.index = clamp(int(floor(line.begin)), 0, highest);
  line.last = clamp(int(floor(end)), walk.index, highest);
  line.inverse = line.last > walk.index ? 1.0 / (end - line.begin) : 0.0;
  // The longest texel of a projection that may be a perspective one.
  float texel = (segment.s1 - segment.s0) * line.inverse * max(segment.weight, 1.0 / segment.weight);
  float even = evenLength(light, averageThreshold, segment.s0, segment.s1);
#if FOG
  even = evenInFog(even);
#endif
  line.evenLevel = min(int(floor(0.5 * log2(clamp(even / max(texel, 1e-30), 1.0, 1e9)))), kMostEven);
#if CURVES && defined(ROW_CURVES)
  // Nor longer than a cell of the curves, from one to the next of which they may let all or nothing through: in texels of the row.
  vec2 cells = vec2(shadowViews[segment.view].size) / (float(curvesSize) * max(abs(row.zw), vec2(1e-3)));
  line.evenLevel = min(line.evenLevel, int(floor(0.5 * log2(max(1.01 * min(cells.x, cells.y), 1.0)))));
#endif
#ifdef TINT_SUMS
  line.tintSums = lowRank.valid;
#if FADES
  line.tintSums = lowRank.valid && segment.share == vec2(1.0);
#endif
#endif
  line.depth = segment.p0.z * rowCodeScale + rowCodeOffset;
  line.slope = (segment.p1.z - segment.p0.z) * rowCodeScale;
  walk.u = 0.0;
}

// u where the ray leaves the texels before `index`.
float rowEnd(RowLine line, RowWalk walk, int index) {
  return index > line.last ? 1.0 : clamp((float(index) - line.begin) * line.inverse, walk.u, 1.0);
}

const float kMixed = 0.5;

// Visibility of a stretch from one coded depth to another among stored depths between the bounds: 1 all lit, 0 all dark,
// or kMixed.
float boundsVisibility(float begin, float end, vec2 bounds) {
  return max(begin, end) <= bounds.x ? 1.0 : min(begin, end) > bounds.y ? 0.0 : kMixed;
}

const float kAverage = 2.0;

// True if the ray crosses all of a node, between the depths that split it, and the airlight is even enough there for the
// node's average to stand for it; or (TINT_SUMS) whatever the airlight.
bool isAverage(RowLine line, RowWalk walk, int level, int next, float end, vec4 split) {
  float begin = rowDepth(line, walk.u);
  bool inside = min(begin, end) > split.y && max(begin, end) <= split.z;
#if FILTER_BILINEAR || GLASS
  if (walk.u > (float(walk.index) - line.begin) * line.inverse + 1e-6 * line.inverse) return false; // within a texel
#endif
#ifdef TINT_SUMS
  return inside && line.tintSums && float(walk.index) >= line.begin && next <= line.last;
#endif
  return inside && level <= line.evenLevel && float(walk.index) >= line.begin && next <= line.last + 1;
}

Average averageAt(int node, int row) {
#if GLASS
  return averageOf(texelFetch(rowMeans, ivec2(node, row), 0), texelFetch(rowMoments, ivec2(node, row), 0));
#else
  return averageOf(texelFetch(rowMeans, ivec2(node, row), 0));
#endif
}

// A node of the tree: its place among the row's, and the texel behind its last one.
struct Node {
  int index, end;
};

// Down the tree while a node is mixed, along the row and up again while nodes keep `current`: stackless, one step an
// iteration. Returns the visibility of the node that ended the walk: kMixed before texels to be looked at one by one,
// kAverage before a node whose average stands for it.
float walkNodes(RowLine line, inout RowWalk walk, float current, out Node node) {
  float found = kMixed;
  int level = 2, base = 0; // base: where the level begins
  bool walking = treeLevels > 0 && (walk.index & 15) == 0 && walk.index <= line.last;
  while (walking) {
    VISIT
    int at = walk.index >> (2 * level), next = (at + 1) << (2 * level);
    float u = rowEnd(line, walk, next), end = rowDepth(line, u);
    vec4 split = texelFetch(rowTree, ivec2(base + at, line.row), 0);
    found = boundsVisibility(rowDepth(line, walk.u), end, split.xw);
    if ((found == kMixed || current == kAverage) && isAverage(line, walk, level, next, end, split)) found = kAverage;
    bool taken = found == current, up = taken && level < treeLevels && (next & ((4 << (2 * level)) - 1)) == 0, down = !taken && found == kMixed && level > 2;
    if (taken) walk = RowWalk(next, u);
    walking = taken ? walk.index <= line.last : down;
    base += up ? rowLength >> (2 * level) : 0;
    level += up ? 1 : down ? -1 : 0;
    base -= down ? rowLength >> (2 * level) : 0;
  }
  int at = walk.index >> (2 * level);
  node = Node(base + at, (at + 1) << (2 * level));
  return found;
}

#if FILTER_BILINEAR || GLASS
#include "lib/rowFiltered.glsl"
#else
#include "lib/rowNearest.glsl"
#endif

#endif
