// Light behind smoke and hair: the curves of an adaptive volumetric shadow map (DESIGN 1, A; Salvi 2013) along a camera ray. Cells are
// texels of the map along the ray's main axis; across it the two nearest texels are weighted linearly. In a cell the
// transmittance's mean and first moment stand for it, exact for its lines between nodes.
//
// ROW_CURVES: with the cells of the slice's row and a tree over them (curveCells.frag, curveTree.frag). All rays of the slice run along
// it: what lies before the first segment, or behind the last, is taken whole. Needs lib/curveNodes.glsl.

uniform usampler2DArray curves; // glsl/public/avsmLookup.glsl

// The two texels of a cell beside a line, and the weight of the second.
ivec3 cellTexel(bool alongX, bool mirrored, int view, int cell, int across) {
  ivec2 at = clamp(ivec2(mirrored ? curvesSize - 1 - cell : cell, across), ivec2(0), ivec2(curvesSize - 1));
  return ivec3(alongX ? at : at.yx, view);
}

// Ends of both texels' curves: where the first begins, where the last ends, what passes behind both.
vec3 cellEnds(bool alongX, bool mirrored, int view, int cell, float across) {
  float at = across - 0.5, low = floor(at);
  vec3 a = curveEnds(curves, texelsPerCurve, curvesPacked, cellTexel(alongX, mirrored, view, cell, int(low)));
  vec3 b = curveEnds(curves, texelsPerCurve, curvesPacked, cellTexel(alongX, mirrored, view, cell, int(low) + 1));
  return vec3(min(a.x, b.x), max(a.y, b.y), mix(a.z, b.z, at - low));
}

#ifndef CURVES_ALONE

// A segment among the cells of its view's map: at u it is in cell begin + u extent, counted so that it never falls.
struct CurveLine {
  int turned; // 1: along y, +2: against the axis
  float begin, extent;
  float across, acrossExtent;
  int row; // ROW_CURVES: that it runs along
} curveLine;

void startCurves(ViewSegment segment, bool alongX, bool mirrored, int row) {
  vec2 scale = float(curvesSize) / vec2(shadowViews[segment.view].size), p = segment.p0.xy * scale, d = segment.p1.xy * scale - p;
  if (!alongX) {
    p = p.yx;
    d = d.yx;
  }
  if (mirrored) {
    p.x = float(curvesSize) - p.x;
    d.x = -d.x;
  }
  curveLine = CurveLine((alongX ? 0 : 1) + (mirrored ? 2 : 0), p.x, max(d.x, 0.0), p.y, d.y, row);
}

// A stretch of a line up to a parameter, over which the transmittance has a mean and a first moment.
struct Dimmed {
  float to;
  vec2 passed;
};

float linearDepthAt(ViewSegment segment, float s) {
  return mix(segment.curveDepth.x, segment.curveDepth.y, clamp((s - segment.s0) / max(segment.s1 - segment.s0, 1e-30), 0.0, 1.0));
}

#ifdef ROW_CURVES
uniform sampler2D curveCells; // cells x rows: as cellEnds
uniform sampler2D curveTree;  // nodes of 4, 16, ... cells behind one another x rows; w: the first moment of what passes

#define EVEN_STRETCH averageThreshold
#else
#define EVEN_STRETCH 0.05
#endif

float evenStretch(Airlight light, ViewSegment segment) {
  float even = evenLength(light, EVEN_STRETCH, segment.s0, segment.s1);
#if FOG
  even = evenInFog(even);
#endif
  return even;
}

// The transmittance of a cell from one parameter to another.
vec2 cellPassed(ViewSegment segment, int cell, float u0, float u1) {
  float depth0 = linearDepthAt(segment, distanceAt(segment, u0)), depth1 = linearDepthAt(segment, distanceAt(segment, u1));
  float nearer = min(depth0, depth1), farther = max(max(depth0, depth1), nearer + 1e-7); // a ray across the light stays at one depth
  float at = curveLine.across + 0.5 * (u0 + u1) * curveLine.acrossExtent - 0.5, low = floor(at);
  vec2 passed = vec2(0.0);
  for (int k = 0; k < 2; ++k) {
    ivec3 texel = cellTexel((curveLine.turned & 1) == 0, curveLine.turned > 1, segment.view, cell, int(low) + k);
    passed += (k == 0 ? 1.0 - (at - low) : at - low) * curveBetween(curves, texelsPerCurve, curvesPacked, texel, nearer, farther);
  }
  return vec2(passed.x, depth1 < depth0 ? -passed.y : passed.y);
}

// The stretch from u on, no farther than to `end`: all that is clear or, if nothing is there, one that is dimmed evenly.
Dimmed nextDimmed(Airlight light, ViewSegment segment, float u, float end) {
  int cells = curvesSize, cell = clamp(int(floor(curveLine.begin + u * curveLine.extent)), 0, cells - 1), level = 0, base = 0;
  float even = evenStretch(light, segment), begin = u, to;
  vec2 passed; // of a node behind which the stretch lies
  bool searching = u < end, known = false;
  for (int guard = 0; guard < 8 * cells && searching; ++guard) {
    int node = cell >> (2 * level), next = (node + 1) << (2 * level);
    bool last = next >= cells || curveLine.extent == 0.0;
    to = last ? end : clamp((float(next) - curveLine.begin) / curveLine.extent, u, end);
    if (!(to > u) && !last) { // rounding left the walk a step behind
      cell = next;
      level = base = 0;
      continue;
    }
    float s = distanceAt(segment, u), sTo = distanceAt(segment, to), depth = linearDepthAt(segment, s), depthTo = linearDepthAt(segment, sTo);
#ifdef ROW_CURVES
    vec4 ends = level == 0 ? vec4(texelFetch(curveCells, ivec2(node, curveLine.row), 0).rgb, 0.0) : texelFetch(curveTree, ivec2(base + node, curveLine.row), 0);
#else
    vec4 ends = vec4(cellEnds((curveLine.turned & 1) == 0, curveLine.turned > 1, segment.view, cell, curveLine.across + 0.5 * (u + to) * curveLine.acrossExtent), 0.0);
#endif
    bool clear = max(depth, depthTo) <= ends.x, behind = min(depth, depthTo) >= ends.y;
    bool whole = level == 0 || (sTo - s <= even && (node << (2 * level)) == cell && float(cell) >= curveLine.begin + u * curveLine.extent - 1e-3 && to < end);
    passed = ends.zw;
    known = behind && whole;
    if (clear || (behind && ends.z == 1.0)) {
      cell = next;
      u = to;
      searching = u < end && !last;
#ifdef ROW_CURVES
      bool up = (next & ((4 << (2 * level)) - 1)) == 0 && next < cells;
      if (up) {
        base += level == 0 ? 0 : (cells + (1 << (2 * level)) - 1) >> (2 * level);
        ++level;
      }
#endif
    } else if (known || level == 0) {
      break;
    } else {
      --level;
      base -= level == 0 ? 0 : (cells + (1 << (2 * level)) - 1) >> (2 * level);
    }
  }
  if (!searching || u > begin) return Dimmed(searching ? u : end, vec2(1.0, 0.0));
  if (known) return Dimmed(to, passed);
  // A line stands for the transmittance only where the airlight hardly changes; but at most 64 pieces of a ray along the light.
  float s = distanceAt(segment, u), piece = max(even, (segment.s1 - segment.s0) / 64.0), cut = clamp(parameterAt(segment, s + piece), u, to);
  if (distanceAt(segment, to) - s > piece && cut > u) to = cut;
  return Dimmed(to, cellPassed(segment, cell, u, to));
}

// Adds the light of a span of a segment whose visibility is that of a line, behind what dims it.
void addCurved(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment, inout Light sum) {
  float u = u0;
  while (u < u1) {
    Dimmed next = nextDimmed(light, segment, u, u1);
    float sa = distanceAt(segment, u), sb = distanceAt(segment, next.to);
    u = next.to > u ? next.to : u1;
    if (!(sb > sa) || next.passed.x <= 0.0) continue;
    VisibilityLine own = dimmedBy(partOf(VisibilityLine(mean, moment), distanceAt(segment, u0), distanceAt(segment, u1), sa, sb), next.passed);
    addShared(light, segment, sa, sb, own.mean, own.moment, sum);
  }
}

#endif
