#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define SHADOW_VIEWS 2
#define GLASS 0
// Row tree: all levels of the tree behind one another, each gathered from the finest (Chen 2011, 3.3; lib/split.glsl).

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

uniform sampler2D rowNodes;
uniform sampler2D rowNodeMeans;
#if GLASS
uniform sampler2D rowNodeMoments;
#endif

layout(location = 0) out vec4 outSplit;
layout(location = 1) out vec4 outMean;
#if GLASS
layout(location = 2) out vec4 outMoment;
#endif

Average averageAt(ivec2 at) {
#if GLASS
  return averageOf(texelFetch(rowNodeMeans, at, 0), texelFetch(rowNodeMoments, at, 0));
#else
  return averageOf(texelFetch(rowNodeMeans, at, 0));
#endif
}

void main() {
  int row = int(gl_FragCoord.y), view = viewOfRow(row), node = int(gl_FragCoord.x), level = 2;
  while (node >= rowLength >> (2 * level) && level < treeLevels) {
    node -= rowLength >> (2 * level);
    ++level;
  }
  int count = 1 << (2 * (level - 2)), first = node * count;
  vec4 split = texelFetch(rowNodes, ivec2(first, row), 0);
  Average average = averageAt(ivec2(first, row));
  if (count > 1) {
    vec2 bounds = vec2(3.4e38, -3.4e38);
    for (int i = 0; i < count; ++i) {
      vec2 one = texelFetch(rowNodes, ivec2(first + i, row), 0).xw;
      bounds = vec2(min(bounds.x, one.x), max(bounds.y, one.y));
    }
    float middle = splitOf(view, bounds.x, bounds.y);
    split = splitOfBounds(bounds.x, bounds.y);
    average = Average(Share(0.0), Share(0.0));
    for (int i = 0; i < count; ++i) {
      ivec2 at = ivec2(first + i, row);
      addChild(texelFetch(rowNodes, at, 0), averageAt(at), i, count, middle, split, average);
    }
  }
  outSplit = split;
  outMean = storedMean(average);
#if GLASS
  outMoment = storedMoment(average);
#endif
}
