// Visibility along a slice's row, with a min/max tree over it (Chen 2011, 3.3; Yusov 2013). The row holds the shadow map's
// texels along the slice, one per step; all rays of the slice run along it, each with its own linear depth.
//
// rowDepths: slices x texels / 4, RGBA32F: four depths, or, where more than the texels themselves decides (2x2 filter,
// glass), the bounds of the four in x, y. rowTree: slices x nodes, RG32F: min and max of 16 texels (level 2), then of 64,
// 256, ... (levels 3, 4, ...). Depths grow away from the light; 3e38 without a caster. Level l of a row of T texels holds
// T / 4^l nodes, behind those of the levels below.

#if SHADOW_VIEWS > 0

uniform sampler2D rowDepths;
uniform sampler2D rowTree;

vec2 groupBounds(vec4 depths) {
#if FILTER_BILINEAR || GLASS
  return depths.xy;
#else
  return vec2(min(min(depths.x, depths.y), min(depths.z, depths.w)), max(max(depths.x, depths.y), max(depths.z, depths.w)));
#endif
}

// A ray on its row: u runs from 0 to 1 over the segment, the row index at u is begin + u * extent.
struct RowLine {
  vec2 origin, step; // of the row, texels
  float begin, inverse; // inverse: 1 / extent, or 0 if the ray does not move along the row
  float depth, slope;
  int last; // index of the last texel
};

struct RowWalk {
  int index;
  float u, depth;
};

void startRow(ViewSegment segment, int slice, out RowLine line, out RowWalk walk) {
  vec4 row = texelFetch(sliceTable, ivec2(slice, march.y), 0);
  line.origin = row.xy;
  line.step = row.zw;
  int highest = max(int(texelFetch(sliceTable, ivec2(slice, march.y + 1), 0).x), 1) - 1;
  float scale = 1.0 / dot(row.zw, row.zw);
  line.begin = dot(segment.p0.xy - row.xy, row.zw) * scale;
  float end = dot(segment.p1.xy - row.xy, row.zw) * scale;
  walk.index = clamp(int(floor(line.begin)), 0, highest);
  line.last = clamp(int(floor(end)), walk.index, highest);
  line.inverse = line.last > walk.index ? 1.0 / (end - line.begin) : 0.0;
  line.depth = segment.p0.z;
  line.slope = segment.p1.z - segment.p0.z;
  walk.u = 0.0;
  walk.depth = line.depth;
}

// u where the ray leaves the texels before `index`.
float rowEnd(RowLine line, RowWalk walk, int index) {
  return index > line.last ? 1.0 : clamp((float(index) - line.begin) * line.inverse, walk.u, 1.0);
}

void advanceRow(RowLine line, inout RowWalk walk, int index, float u) {
  walk.index = index;
  walk.u = u;
  walk.depth = line.depth + line.slope * u;
}

// True if nothing changes in stored depths between `low` and `high` along [walk.u, u].
bool keeps(RowLine line, RowWalk walk, float u, float low, float high, Visibility current) {
  float end = line.depth + line.slope * u;
  bool lit = max(walk.depth, end) <= low, dark = min(walk.depth, end) > high;
  return lit ? current == Visibility(1.0) : dark && current == Visibility(0.0);
}

// Visibility of [walk.u, u] in one texel; u is cut where the ray crosses a stored depth.
Visibility texelVisibility(RowLine line, RowWalk walk, int slice, int view, inout float u) {
#if FILTER_BILINEAR || GLASS
  vec2 p = line.origin + line.step * (float(walk.index) + 0.5);
#if FILTER_BILINEAR
  p -= 0.5;
#endif
  // The texel's own sampling point stands for all of it: a line that does not move in x and y.
  Line still;
  still.origin = vec3(p, line.depth);
  still.slope = vec3(0.0, 0.0, line.slope);
  return pieceVisibility(still, clamp(ivec2(floor(p)), ivec2(FILTER_BILINEAR == 1 ? -1 : 0), viewCounts.zw - 1), view, walk.u, u);
#else
  float depth = texelFetch(rowDepths, ivec2(slice, walk.index >> 2), 0)[walk.index & 3];
  float crossing = (depth - line.depth) / line.slope;
  if (crossing > walk.u && crossing < u) u = crossing;
  return line.depth + line.slope * (0.5 * (walk.u + u)) <= depth ? 1.0 : 0.0;
#endif
}

// The same integral as segmentLight, over the slice's row: nodes that change nothing are skipped, groups of four texels
// likewise; what is left is looked at texel by texel.
Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(segment, slice, line, walk);
  int view = segment.view, level = 2, top = grid.w;
  int guard = 3 * (line.last - walk.index + 1) + 16; // bounds the loops whatever the arithmetic does
  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  bool done = false;
  while (!done) {
    Visibility weight = Visibility(0.0);
    float begin = 0.0, end = 0.0;
    while (!done && weight == Visibility(0.0)) {
      // Down the tree while a node is mixed, along the row and up again while nodes change nothing.
      bool walking = (walk.index & 15) == 0 && walk.index <= line.last && top >= 2;
      level = 2;
      int base = 0; // where the level begins
      while (walking) {
        int next = ((walk.index >> (2 * level)) + 1) << (2 * level);
        float u = rowEnd(line, walk, next);
        vec2 bounds = texelFetch(rowTree, ivec2(slice, base + (walk.index >> (2 * level))), 0).rg;
        if (keeps(line, walk, u, bounds.x, bounds.y, current)) {
          advanceRow(line, walk, next, u);
          bool up = level < top && (next & ((4 << (2 * level)) - 1)) == 0;
          base += up ? grid.z >> (2 * level) : 0;
          level += up ? 1 : 0;
          walking = walk.index <= line.last;
        } else {
          walking = level > 2;
          --level;
          base -= walking ? grid.z >> (2 * level) : 0;
        }
      }
      // Groups of four texels, up to the next node.
      int nodeEnd = ((walk.index >> 4) + 1) << 4;
      walking = walk.index <= line.last;
      while (walking) {
        int next = ((walk.index >> 2) + 1) << 2;
        float u = rowEnd(line, walk, next);
        vec4 depths = texelFetch(rowDepths, ivec2(slice, walk.index >> 2), 0);
        vec2 bounds = groupBounds(depths);
        walking = keeps(line, walk, u, bounds.x, bounds.y, current);
        if (walking) {
          advanceRow(line, walk, next, u);
          walking = walk.index <= line.last && walk.index < nodeEnd;
        }
      }
      // One texel, or a part of it.
      done = walk.index > line.last || guard <= 0;
      float uTexel = rowEnd(line, walk, walk.index + 1), u = uTexel;
      bool look = !done && walk.index < nodeEnd; // else the next node's turn
      Visibility visibility = Visibility(0.0);
      if (look) visibility = texelVisibility(line, walk, slice, view, u);
      if ((look || done) && visibility != current) {
        weight = current;
        begin = from;
        end = walk.u;
        current = visibility;
        from = walk.u;
      }
      --guard;
      if (look) {
        if (u < uTexel) advanceRow(line, walk, walk.index, u);
        else advanceRow(line, walk, walk.index + 1, uTexel);
      }
    }
    sum += Light(weight) * Light(airlight(light, distanceAt(segment, begin), distanceAt(segment, end)));
  }
  return sum;
}

#endif
