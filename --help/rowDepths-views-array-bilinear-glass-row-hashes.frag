#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define SHADOW_VIEWS 2
#define SHADOW_ARRAY 1
#define FILTER_BILINEAR 1
#define GLASS 1
#define ROW_HASHES 1
// Row depths: the shadow map along each slice, one texel a step, four steps a fragment (Chen 2011, 3.2).

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


#if SHADOW_ARRAY
uniform sampler2DArray shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, ivec3(texel, shadowViews[view].layer), 0)
#else
uniform sampler2D shadowMap;
#define TEXEL(map, texel, view) texelFetch(map, texel, 0)
#endif
#if GLASS
#if SHADOW_ARRAY
uniform sampler2DArray glassColour;
uniform sampler2DArray glassDepth;
#else
uniform sampler2D glassColour;
uniform sampler2D glassDepth;
#endif
#endif

float casterDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(shadowMap, texel, view).r;
  return depth < shadowViews[view].farDepth ? depth : 3e38;
}

#if GLASS
float paneDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(glassDepth, texel, view).r;
  return depth < 3e38 ? depth : 3e38;
}
vec3 paneTint(ivec2 texel, int view) {
  vec3 tint = TEXEL(glassColour, texel, view).rgb;
  return mix(vec3(0.0), min(tint, vec3(1.0)), greaterThanEqual(tint, vec3(0.0)));
}
#endif

vec4 cornerDepths(ivec2 cell, int view) {
  ivec2 last = shadowMapSize - 1;
  ivec2 low = max(cell, ivec2(0)), high = min(cell + 1, last);
  return vec4(casterDepth(low, view), casterDepth(ivec2(high.x, low.y), view), casterDepth(ivec2(low.x, high.y), view),
              casterDepth(high, view));
}

#if GLASS
vec4 cornerPanes(ivec2 cell, int view) {
  ivec2 last = shadowMapSize - 1;
  ivec2 low = max(cell, ivec2(0)), high = min(cell + 1, last);
  return vec4(paneDepth(low, view), paneDepth(ivec2(high.x, low.y), view), paneDepth(ivec2(low.x, high.y), view),
              paneDepth(high, view));
}
#endif


#if GLASS
#define Share vec3 // mean visibility, or a moment of it
#else
#define Share float
#endif

struct Average {
  Share mean, moment;
};

#ifdef TINT_SUMS
const vec4 kNoSplit = vec4(3.4e38, -3.4e38, 3.4e38, -3.4e38);
vec4 splitOfBounds(float lowest, float highest) { return vec4(lowest, -3.4e38, 3.4e38, highest); }
#else
const vec4 kNoSplit = vec4(3.4e38, 3.4e38, -3.4e38, -3.4e38);
vec4 splitOfBounds(float lowest, float highest) { return vec4(lowest, lowest, highest, highest); }
#endif

#if GLASS
vec4 storedMean(Average average) { return vec4(average.mean, 0.0); }
vec4 storedMoment(Average average) { return vec4(0.5 * average.moment + 0.5, 0.0); }
Average averageOf(vec4 mean, vec4 moment) { return Average(mean.rgb, 2.0 * moment.rgb - 1.0); }
#else
vec4 storedMean(Average average) { return vec4(average.mean, 0.5 * average.moment + 0.5, 0.0, 0.0); }
Average averageOf(vec4 stored) { return Average(stored.r, 2.0 * stored.g - 1.0); }
#endif

float splitOf(int view, float lowest, float highest) {
  float far = shadowViews[view].farDepth * rowCodeScale + rowCodeOffset;
  return 0.5 * (lowest + min(highest, max(far, lowest)));
}

void addChild(vec4 child, Average childAverage, int i, int count, float middle, inout vec4 split, inout Average average) {
#ifdef TINT_SUMS
  split.yz = vec2(max(split.y, child.y), min(split.z, child.z));
#else
  Average part = Average(Share(0.0), Share(0.0));
  if (child.x > middle) { // all behind
    split.z = min(split.z, child.x);
    part.mean = Share(child.x <= child.w ? 1.0 : 0.0);
  } else if (child.w <= middle) { // all before
    split.y = max(split.y, child.w);
  } else {
    split.y = max(split.y, child.y);
    split.z = min(split.z, child.z);
    part = childAverage;
  }
  float scale = 1.0 / float(count), place = (2.0 * float(i) + 1.0) * scale - 1.0;
  average.mean += part.mean * scale;
  average.moment += (part.mean * place + part.moment * scale) * scale;
#endif
}


layout(location = 0) out vec4 outDepths;

float coded(float depth) { return depth > 1e38 ? emptyRowCode : depth * rowCodeScale + rowCodeOffset; }

#if FILTER_BILINEAR || GLASS

layout(location = 1) out vec4 outShare;
#ifdef ROW_HASHES
layout(location = 2) out vec4 outHash; // of all that decides, to tell a change by: a group's split and share may hide it
#endif

struct Point {
  vec4 caster, pane, weights;
  ivec4 corners; // low x, low y, high x, high y
};

ivec2 cornerOf(Point point, int i) { return ivec2(i % 2 == 0 ? point.corners.x : point.corners.z, i < 2 ? point.corners.y : point.corners.w); }

Point pointAt(vec2 p, int view) {
  ivec2 last = shadowMapSize - 1;
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
  point.corners = ivec4(low, high);
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
  ivec2 last = shadowMapSize - 1;
  for (int k = 0; k < 4; ++k) {
    vec2 p = row.xy + row.zw * (float(first + k) + 0.5);
    outDepths[k] = coded(casterDepth(clamp(ivec2(floor(p)), ivec2(0), last), view));
  }
}

#endif
