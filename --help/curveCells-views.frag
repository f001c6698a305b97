#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define SHADOW_VIEWS 2
// Curve cells: where smoke and hair begin and end along each slice's row in the map of their curves, cell by cell along the row's
#define CURVES_ALONE

#define MAX_CONSTITUENTS 4
#define MAX_SHADOW_VIEWS 6
#define MAX_DEPTH_SAMPLES 16
#define EPIPOLE_GAP 0.25 // pixels between an epipole in the image and where slices begin
#define LAMP_PIXELS 32.0 // around a lamp in the image, where every pixel is marched by itself: its light is brightest there

UNIFORM_BLOCK(FrameBlock) {
  vec4 farPoint[3];
  vec4 nearStep;
  float depthOffset, depthScale;      // t = depthOffset + depthScale * depth
  int isOrthographic;
  float skyEnd;                       // ray length for the sky
  vec3 extinction;                    // sigma_t
  float visibleEnd;                   // ray length beyond which nothing visible is added
  vec4 phaseWeight[MAX_CONSTITUENTS]; // share of sigma_k in the scattering of all constituents, rgb, times the norm of p_k
  vec4 phaseShape[MAX_CONSTITUENTS];  // a, b, c, side: p_k ~ (1 + c cos^2) (a + b (1 -+ cos))^(-3/2), - for side > 0
  float lightCeiling;                 // largest radiance that a light may add,
  float colourMax, outputMax;         // that the colour's format holds, the output's
  int isMultisampled;                 // the depth texture
  int constituentCount;
  int depthSampleCount;               // of a pixel
  ivec2 frameSize;                    // of the image, pixels
};

struct MapView {
  mat4 texelFromCamera;               // (x, y, z, 1) to (texel x, texel y, depth, 1) w; depth grows away from the light
  vec4 margin;                        // what lies beyond a side by at most xy + s zw (x, y times w), which is rounding, belongs to the view
  vec4 curveDepth;                    // depth of the curves (lib/curves.glsl) at x: dot(xyz, x) + w, 0 at the near and 1 at the far plane
  float nearDepth, farDepth;          // of the near and the far plane
  float depthSign;                    // of stored depth
  int isOpen;                         // 1 if open beyond the far plane
  int layer;                          // of an array
  int viewPadding0, viewPadding1, viewPadding2;
};

UNIFORM_BLOCK(LightBlock) {
  vec3 lightColour;                   // irradiance or radiant intensity times the scattering coefficient of all constituents
  int isLitOutside;                   // 1 if lit outside of the shadow views
  vec3 lightDirection;                // unit; where a directional light travels to, the axis of a spot
  float cascadeFade;                  // share of a shadow view's width over which it fades into the next
  vec3 lightPosition;                 // point, spot
  float lightRange;                   // 0 if without limit
  float outerCosine, innerCosine;     // of a spot's cone; -1 of a point light
  float outerSineSquared, innerSineSquared;
  float falloffScale;                 // 1 / (innerCosine - outerCosine), or 0 for a hard edge
  float falloffPanel;                 // panels (in x of airlight.glsl) up to which two nodes resolve the falloff
  ivec2 shadowMapSize;                // texels
  vec4 boundary;                      // the light's path in the medium at x is max(0, dot(xyz, x) + w); all 0 if none
  int viewCount;                      // shadow views
  int curvesSize, curvesPacked;       // curves: texels per side of their map, 1 if packed,
  int texelsPerCurve;                 // texels that hold one
  MapView shadowViews[MAX_SHADOW_VIEWS];
};

UNIFORM_BLOCK(EpipolarBlock) {
  vec3 epipole;                       // homogeneous window position of the light (x, y, w)
  float epipoleSign;                  // of its w
  vec4 border;                        // low x, low y, high x, high y
  float slicesBegin, sliceWidth;      // arc length of the border where the slices begin, and per slice
  float borderLength;
  int slicesClosed;                   // 1 if the last slice neighbours the first
  int sliceCount, samplesPerSlice;
  int rowLength, treeLevels;          // texels of a row, levels of its tree or 0: none
  float breakThreshold;               // relative change of distance that is a break,
  float endThreshold;                 // as a difference of end coordinates (lib/stored.glsl)
  float bendThreshold;                // bend of the inscatter that is refined
  float leastWeight;                  // bilateral
  float spreadThreshold;              // spread of the samples around a pixel, as a part of the picture's mean, over which it is marched by itself
  float averageThreshold;             // optical depth of a stretch of a row that is taken by its average
  int firstRefreshedSlice;            // temporal reuse: slices that are drawn anew though nothing has changed,
  int endRefreshedSlice;              // up to this one
  float rowCodeScale, rowCodeOffset;  // coded depth of a row = rowCodeScale depth + rowCodeOffset;
  float emptyRowCode;                 // that of a texel without a caster
  float rowCodeSteps;                 // 65535 if it is stored in 16 bit, else 0
  vec3 storedScale;                   // of colours in half floats (lib/stored.glsl)
  float leastCoordinate;              // end coordinate of the lowest code
  int firstView, drawnViews;          // shadow views of a draw
  int bringsOutside;                  // 1 for the draw that brings what is outside all views
  int lowRankTerms;                   // low rank (lib/lowRank.glsl)
  float lowRankRayBegin;              // first coordinate of the grid of camera rays,
  float lowRankRayScale;              // samples a unit
  float lowRankLightBegin;            // the same of light rays,
  float lowRankLightExtent;           // of the whole grid
  int lowRankPerSlice;                // 1 if each slice has factors of its own
  int comparesEnds, comparesRows;     // temporal reuse: what is compared with the last frame's,
  int comparesDepth, comparesSome;    // the depth itself, only some of the slices
  int shownSamples;                   // debug views of samples: 0 all, 1 at depth breaks, 2 march samples
  int epipolarPadding0, epipolarPadding1;
};


uniform sampler2D sliceTable;

vec4 sliceEnds(int slice) { return texelFetch(sliceTable, ivec2(slice, 0), 0); }
int sliceSamples(int slice) { return int(texelFetch(sliceTable, ivec2(slice, 1), 0).w) + 1; }

vec2 samplePosition(vec4 ends, int samples, float index) {
  return mix(ends.xy, ends.zw, index / float(max(samples - 1, 1)));
}

float sliceCoordinate(vec2 p) {
  vec2 d = epipoleSign * (epipole.z * p - epipole.xy);
  vec2 target = mix(border.xy, border.zw, greaterThan(d, vec2(0.0)));
  vec2 steps = mix(vec2(3e38), (target - p) / d, notEqual(d, vec2(0.0)));
  bool throughX = steps.x < steps.y;
  vec2 exit = clamp(p + d * min(min(steps.x, steps.y), 3e37), border.xy, border.zw);
  vec2 size = border.zw - border.xy, local = exit - border.xy;
  float arc = throughX ? (d.x > 0.0 ? size.x + local.y : 2.0 * size.x + size.y + (size.y - local.y))
                       : (d.y > 0.0 ? size.x + size.y + (size.x - local.x) : local.x);
  float along = arc - slicesBegin;
  along += along < 0.0 ? borderLength : 0.0;
  return along / sliceWidth - 0.5;
}

ivec2 neighbourSlices(float coordinate) {
  int low = int(floor(coordinate)), last = sliceCount - 1;
  if (slicesClosed != 0) return ivec2((low + sliceCount) % sliceCount, (low + 1 + sliceCount) % sliceCount);
  return clamp(ivec2(low, low + 1), ivec2(0), ivec2(last));
}

#if SHADOW_VIEWS == 2
int drawnViewOfRow(int y) { return int((float(y) + 0.5) / float(sliceCount)); }
int viewOfRow(int y) { return firstView + drawnViewOfRow(y); }
int sliceOfRow(int y) { return y - sliceCount * drawnViewOfRow(y); }
int rowOf(int view, int slice) { return (view - firstView) * sliceCount + slice; }
#else
int viewOfRow(int y) { return 0; }
int sliceOfRow(int y) { return y; }
int rowOf(int view, int slice) { return slice; }
#endif

vec4 rowLine(int view, int slice) { return texelFetch(sliceTable, ivec2(slice, 2 + 2 * view), 0); }

bool isAlongX(vec4 row) { return abs(row.z) >= abs(row.w); }

int rowLast(int view, int slice) { return max(int(texelFetch(sliceTable, ivec2(slice, 3 + 2 * view), 0).x), 1) - 1; }

int rowTexels(int view, int slice) { return (rowLast(view, slice) | 15) + 1; }


struct ViewSegment {
  int view;
  vec3 p0, p1;
};


uniform usampler2DArray curves; // glsl/public/avsmLookup.glsl

struct CurveNodes {
  vec4 depths, passed; // nearest first; the last one again where a texel holds only two
};

CurveNodes curveNodes(ivec3 texel, int i) {
  uvec4 stored = texelFetch(curves, ivec3(texel.xy, texel.z * texelsPerCurve + i), 0);
  if (curvesPacked != 0) return CurveNodes(vec4(stored >> 16u) * (1.0 / 65535.0), vec4(stored & 0xFFFFu) * (1.0 / 65535.0));
  vec4 nodes = uintBitsToFloat(stored);
  return CurveNodes(nodes.xzzz, nodes.ywww);
}

vec3 curveEnds(ivec3 texel) {
  CurveNodes last = curveNodes(texel, texelsPerCurve - 1);
  return vec3(curveNodes(texel, 0).depths.x, last.depths.w, last.passed.w);
}

void addLine(vec2 a, vec2 b, float low, float high, inout vec2 sum) {
  float from = clamp(a.x, low, high), to = clamp(b.x, low, high);
  if (!(to > from)) return;
  float slope = (b.y - a.y) / (b.x - a.x), halfLength = 0.5 * (high - low), middle = 0.5 * (low + high);
  float va = a.y + slope * (from - a.x), vb = a.y + slope * (to - a.x);
  float xa = (from - middle) / halfLength, xb = (to - middle) / halfLength;
  sum += (to - from) * vec2(0.5 * (va + vb), (va * xa + (va + vb) * (xa + xb) + vb * xb) / 6.0);
}

vec2 curveBetween(ivec3 texel, float low, float high) {
  vec2 sum = vec2(0.0), before = vec2(-1e9, 1.0);
  for (int i = 0; i < texelsPerCurve && before.x < high; ++i) {
    CurveNodes nodes = curveNodes(texel, i);
    for (int k = 0; k < 4; ++k) {
      vec2 node = vec2(nodes.depths[k], nodes.passed[k]);
      addLine(before, node, low, high, sum);
      before = node;
    }
  }
  addLine(before, vec2(1e9, before.y), low, high, sum);
  return sum / (high - low);
}

struct CurveLine {
  bool alongX, mirrored;
  float begin, extent;
  float across, acrossExtent;
  int view;
};

CurveLine curveLine(ViewSegment segment, bool alongX, bool mirrored) {
  vec2 scale = float(curvesSize) / vec2(shadowMapSize), p = segment.p0.xy * scale, d = segment.p1.xy * scale - p;
  if (!alongX) {
    p = p.yx;
    d = d.yx;
  }
  if (mirrored) {
    p.x = float(curvesSize) - p.x;
    d.x = -d.x;
  }
  return CurveLine(alongX, mirrored, p.x, max(d.x, 0.0), p.y, d.y, segment.view);
}

ivec3 cellTexel(bool alongX, bool mirrored, int view, int cell, int across) {
  ivec2 at = clamp(ivec2(mirrored ? curvesSize - 1 - cell : cell, across), ivec2(0), ivec2(curvesSize - 1));
  return ivec3(alongX ? at : at.yx, view);
}

vec3 cellEnds(bool alongX, bool mirrored, int view, int cell, float across) {
  float at = across - 0.5, low = floor(at);
  vec3 a = curveEnds(cellTexel(alongX, mirrored, view, cell, int(low))), b = curveEnds(cellTexel(alongX, mirrored, view, cell, int(low) + 1));
  return vec3(min(a.x, b.x), max(a.y, b.y), mix(a.z, b.z, at - low));
}

#ifndef CURVES_ALONE

struct Dimmed {
  float from, to;
  vec2 passed;
};

float linearDepthAt(ViewSegment segment, float s) {
  return mix(segment.curveDepth.x, segment.curveDepth.y, clamp((s - segment.s0) / max(segment.s1 - segment.s0, 1e-30), 0.0, 1.0));
}

#ifdef ROW_CURVES
uniform sampler2D curveCells; // cells x rows: as cellEnds
uniform sampler2D curveTree;  // nodes of 4, 16, ... cells behind one another x rows; w: the first moment of what passes

struct CurveRow {
  bool alongX, mirrored;
  int row;
} curveRow;

float evenStretch(Airlight light) { return evenLength(light, averageThreshold); }
#else
float evenStretch(Airlight light) { return evenLength(light, 0.05); }
#endif

vec2 cellPassed(CurveLine line, int cell, float u0, float u1, float depth0, float depth1) {
  float at = line.across + 0.5 * (u0 + u1) * line.acrossExtent - 0.5, low = floor(at);
  float nearer = min(depth0, depth1), farther = max(max(depth0, depth1), nearer + 1e-7); // a ray across the light stays at one depth
  ivec3 a = cellTexel(line.alongX, line.mirrored, line.view, cell, int(low)), b = cellTexel(line.alongX, line.mirrored, line.view, cell, int(low) + 1);
  vec2 passed = mix(curveBetween(a, nearer, farther), curveBetween(b, nearer, farther), at - low);
  return vec2(passed.x, depth1 < depth0 ? -passed.y : passed.y);
}

Dimmed nextDimmed(Airlight light, ViewSegment segment, CurveLine line, float u, float end) {
  Dimmed found = Dimmed(end, end, vec2(1.0, 0.0));
  int cells = curvesSize, cell = clamp(int(floor(line.begin + u * line.extent)), 0, cells - 1), level = 0, base = 0;
  float even = evenStretch(light), s = distanceAt(segment, u), depth = linearDepthAt(segment, s);
  bool walking = u < end;
  for (int guard = 0; guard < 8 * cells && walking; ++guard) {
    int node = cell >> (2 * level), next = (node + 1) << (2 * level);
    bool last = next >= cells || line.extent == 0.0;
    float to = last ? end : clamp((float(next) - line.begin) / line.extent, u, end);
    if (!(to > u) && !last) { // rounding left the walk a step behind
      cell = next;
      level = base = 0;
      continue;
    }
    float sTo = distanceAt(segment, to), depthTo = linearDepthAt(segment, sTo);
#ifdef ROW_CURVES
    vec4 ends = level == 0 ? vec4(texelFetch(curveCells, ivec2(node, curveRow.row), 0).rgb, 0.0) : texelFetch(curveTree, ivec2(base + node, curveRow.row), 0);
#else
    vec4 ends = vec4(cellEnds(line.alongX, line.mirrored, line.view, cell, line.across + 0.5 * (u + to) * line.acrossExtent), 0.0);
#endif
    bool clear = max(depth, depthTo) <= ends.x, behind = min(depth, depthTo) >= ends.y;
    bool whole = level == 0 || (sTo - s <= even && (node << (2 * level)) == cell && float(cell) >= line.begin + u * line.extent - 1e-3 && to < end);
    if (clear || (behind && ends.z == 1.0)) {
      cell = next;
      u = to;
      s = sTo;
      depth = depthTo;
      walking = u < end && !last;
#ifdef ROW_CURVES
      bool up = (next & ((4 << (2 * level)) - 1)) == 0 && next < cells;
      if (up) {
        base += level == 0 ? 0 : (cells + (1 << (2 * level)) - 1) >> (2 * level);
        ++level;
      }
#endif
    } else if (behind && whole) {
      found = Dimmed(u, to, vec2(ends.z, ends.w));
      walking = false;
    } else if (level > 0) {
      --level;
      base -= level == 0 ? 0 : (cells + (1 << (2 * level)) - 1) >> (2 * level);
    } else {
      float piece = max(even, (segment.s1 - segment.s0) / 64.0), cut = clamp(parameterAt(segment, s + piece), u, to);
      if (sTo - s > piece && cut > u) {
        to = cut;
        depthTo = linearDepthAt(segment, distanceAt(segment, to));
      }
      found = Dimmed(u, to, cellPassed(line, cell, u, to, depth, depthTo));
      walking = false;
    }
  }
  return found;
}

Light curvedLight(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment) {
#ifdef ROW_CURVES
  CurveLine line = curveLine(segment, curveRow.alongX, curveRow.mirrored);
#else
  vec2 d = (segment.p1.xy - segment.p0.xy) / vec2(shadowMapSize);
  bool alongX = abs(d.x) >= abs(d.y);
  CurveLine line = curveLine(segment, alongX, (alongX ? d.x : d.y) < 0.0);
#endif
  float s0 = distanceAt(segment, u0), s1 = distanceAt(segment, u1), inverse = 1.0 / max(s1 - s0, 1e-30);
  Light sum = Light(0.0);
  float u = u0;
  for (int guard = 0; guard < 16384 && u < u1; ++guard) {
    Dimmed next = nextDimmed(light, segment, line, u, u1);
    for (int k = 0; k < 2; ++k) {
      float sa = distanceAt(segment, k == 0 ? u : next.from), sb = distanceAt(segment, k == 0 ? next.from : next.to);
      vec2 passed = k == 0 ? vec2(1.0, 0.0) : next.passed;
      if (!(sb > sa) || passed.x <= 0.0) continue;
      Visibility own = mean + 3.0 * moment * ((sa + sb - s0 - s1) * inverse), ownMoment = moment * ((sb - sa) * inverse);
      sum += sharedLight(light, segment, sa, sb, own * passed.x + 3.0 * ownMoment * passed.y, own * passed.y + ownMoment * passed.x);
    }
    u = next.to > u ? next.to : u1;
  }
  return sum;
}

#endif


layout(location = 0) out vec4 outEnds;

void main() {
  int cell = int(gl_FragCoord.x), view = viewOfRow(int(gl_FragCoord.y));
  vec4 row = rowLine(view, sliceOfRow(int(gl_FragCoord.y)));
  vec2 scale = float(curvesSize) / vec2(shadowMapSize), origin = row.xy * scale, step = row.zw * scale;
  bool alongX = isAlongX(row), mirrored = (alongX ? step.x : step.y) < 0.0;
  if (!alongX) {
    origin = origin.yx;
    step = step.yx;
  }
  float main = mirrored ? float(curvesSize) - float(cell) - 0.5 : float(cell) + 0.5;
  float across = origin.y + step.y * (step.x != 0.0 ? (main - origin.x) / step.x : 0.0);
  outEnds = vec4(cellEnds(alongX, mirrored, view, cell, clamp(across, 0.0, float(curvesSize))), 0.0);
}
