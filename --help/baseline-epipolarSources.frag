#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Which two samples of its line a sample is interpolated between (Engelhardt and Dachsbacher 2010, 4.2): every
// `spacing`-th, and both sides of each depth discontinuity. A sample that is its own source is marched.
// Reads sampleEnds. Writes the two indices, lines x samples, RG32F.
// Uniform blocks and limits, read by the shader compiler and by the C++ compiler (effect/src/SharedBlocks.h), so that
// both see one layout. Every row of a block is 16 bytes: a vec4, four scalars, a vec3 and a scalar, two scalars and a pair, or one of a
// matrix or an array of rows; what is not used of one is named padding. std140 and C++ then agree. Members are global names to shaders.
//
// Positions are relative to the eye (perspective) or to the centre of the clip volume (orthographic), in world units and
// world orientation: no shader adds a world position.

#define MAX_CONSTITUENTS 4
#define MAX_SHADOW_VIEWS 6
#define MAX_DEPTH_SAMPLES 16
#define EPIPOLE_GAP 0.25 // pixels between an epipole in the image and where slices begin
#define LAMP_PIXELS 32.0 // around a lamp in the image, where every pixel is marched by itself: its light is brightest there

UNIFORM_BLOCK(FrameBlock) {
  // The homogeneous point at window position p and t (0 at the far depth, 1 at the near depth) is
  // farPoint[0] + p.x farPoint[1] + p.y farPoint[2] + t nearStep, p in pixels from the image's centre.
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

// A view of a light's shadow map.
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

// Epipolar sampling (Yusov 2013). Window positions are in pixels as gl_FragCoord.xy; the border is the rectangle through
// the outermost pixel centres, around a single row or column of pixels a little wide.
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
// How well two distances along neighbouring rays agree: 1 if alike, falling off where the inverse distances differ by
// more than a tenth. On a plane the inverse distance is close to linear over the image.
float agreementOf(float end, float other) {
  float change = abs(end - other) / max(other, 1e-20);
  float relative = min(10.0 * change, 1e3);
  return 1.0 / (1.0 + relative * relative * relative * relative);
}

// Rays beyond this distance add nothing: the sky's and all others are alike there.
float comparableEnd(float end) { return max(min(end, visibleEnd), 1e-20); }
// Epipolar lines as columns of a table: entry xy and exit xy in pixels. They leave through the part of the image's
// border that faces away from the epipole, evenly spaced along it. Sample j of n lies at j / (n - 1) of the way.
uniform sampler2D lines;  // lines x 1
uniform vec4 lineEpipole; // homogeneous pixel position, w: sign of its w
uniform vec4 lineBorder;  // low x, low y, high x, high y: through the outermost pixel centres
uniform vec4 lineArc;     // where the lines begin, length per line, perimeter; w: 1 if they surround the epipole
uniform vec2 gridSize;    // lines, samples

vec2 sampleAt(vec4 ends, int index) { return mix(ends.xy, ends.zw, float(index) / float(int(gridSize.y) - 1)); }

// The line through a pixel position as a real number. Its direction there is sign(w) (w p - e.xy).
float lineCoordinate(vec2 p) {
  vec2 d = lineEpipole.w * (lineEpipole.z * p - lineEpipole.xy);
  vec2 corner = mix(lineBorder.xy, lineBorder.zw, greaterThan(d, vec2(0.0)));
  vec2 reach = mix(vec2(3e38), (corner - p) / d, notEqual(d, vec2(0.0)));
  vec2 size = lineBorder.zw - lineBorder.xy;
  vec2 exit = clamp(p + d * min(min(reach.x, reach.y), 3e37), lineBorder.xy, lineBorder.zw) - lineBorder.xy;
  float onSides = d.x > 0.0 ? size.x + exit.y : 2.0 * size.x + size.y + (size.y - exit.y);
  float onEnds = d.y > 0.0 ? size.x + size.y + (size.x - exit.x) : exit.x;
  float along = (reach.x < reach.y ? onSides : onEnds) - lineArc.x;
  return (along < 0.0 ? along + lineArc.z : along) / lineArc.y - 0.5;
}

ivec2 linesAround(float coordinate) {
  int low = int(floor(coordinate));
  if (lineArc.w != 0.0) return ivec2((low + int(gridSize.x)) % int(gridSize.x), (low + 1 + int(gridSize.x)) % int(gridSize.x));
  return clamp(ivec2(low, low + 1), ivec2(0), ivec2(int(gridSize.x) - 1));
}

uniform sampler2D sampleEnds;
uniform int spacing;
layout(location = 0) out vec2 outSources;

bool isBreak(float a, float b) { return abs(a - b) > 0.1 * max(a, b); }

void main() {
  int line = int(gl_FragCoord.x), index = int(gl_FragCoord.y);
  int first = index / spacing * spacing, last = min(first + spacing, int(gridSize.y) - 1);
  float end = comparableEnd(texelFetch(sampleEnds, ivec2(line, index), 0).r);
  int low = index, high = index;
  float before = end;
  for (bool walking = low > first; walking;) {
    float next = comparableEnd(texelFetch(sampleEnds, ivec2(line, low - 1), 0).r);
    walking = !isBreak(before, next);
    if (walking) --low;
    before = next;
    walking = walking && low > first;
  }
  before = end;
  for (bool walking = high < last && index > first; walking;) {
    float next = comparableEnd(texelFetch(sampleEnds, ivec2(line, high + 1), 0).r);
    walking = !isBreak(before, next);
    if (walking) ++high;
    before = next;
    walking = walking && high < last;
  }
  if (index == first) low = high = index;
  outSources = vec2(low, high);
}
