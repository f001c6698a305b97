#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define LIGHT_KIND 0
#define SHADOW_VIEWS 2
#define SHADOW_ARRAY 1
#define FILTER_BILINEAR 0
#define GLASS 1
#define MONOCHROME 0
// Tint groups: each low-rank term of the light that crosses four texels of a row, times their tints (Chen 2011, 3.4).

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


struct Ray {
  vec3 origin;    // eye, or the point on the near plane of an orthographic camera
  vec3 direction; // unit
};

Ray cameraRay(vec2 windowPosition) {
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec3 far = farPoint[0].xyz + p.x * farPoint[1].xyz + p.y * farPoint[2].xyz;
  if (isOrthographic != 0) return Ray(far + nearStep.xyz, normalize(-nearStep.xyz));
  return Ray(vec3(0.0), normalize(far));
}

float rayEnd(vec2 windowPosition, float depth) {
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return t <= 0.0 ? skyEnd : -1.0;
  if (isOrthographic != 0) return max(0.0, 1.0 - t) * length(nearStep.xyz);
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  return length(far.xyz) / (far.w + t * nearStep.w);
}


#if MONOCHROME
#define Spectrum float
#define SPECTRUM(v) (v).x
#else
#define Spectrum vec3
#define SPECTRUM(v) (v).rgb
#endif

vec3 transmittanceTo(float s) { return vec3(exp(-SPECTRUM(extinction) * s)); }

Spectrum phaseTowardsEye(float oneMinusCos, float onePlusCos) {
  float cosSquared = 0.25 * (onePlusCos - oneMinusCos) * (onePlusCos - oneMinusCos);
  Spectrum sum = Spectrum(0.0);
  for (int k = 0; k < constituentCount; ++k) {
    vec4 shape = phaseShape[k];
    float d = shape.x + shape.y * (shape.w > 0.0 ? oneMinusCos : onePlusCos);
    float r = inversesqrt(d);
    sum += SPECTRUM(phaseWeight[k]) * ((1.0 + shape.z * cosSquared) * (r * r * r));
  }
  return sum;
}

Spectrum phaseAlong(Ray ray) {
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  return phaseTowardsEye(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
}


float relativeExpm1(float x) {
  if (x < 0.5) {
    return 1.0 + x * (-1.0 / 2.0 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0 + x * (-1.0 / 720.0 +
                 x * (1.0 / 5040.0 + x * (-1.0 / 40320.0)))))));
  }
  return (1.0 - exp(-x)) / x;
}
vec3 relativeExpm1(vec3 x) { return vec3(relativeExpm1(x.x), relativeExpm1(x.y), relativeExpm1(x.z)); }

#if LIGHT_KIND == 0

struct Airlight {
  Spectrum phase; // constant along the ray
  float path;     // the light's way through the medium to the point s is max(0, path + s pathSlope)
  float pathSlope;
};

Airlight airlightOf(Ray ray) {
#ifdef PHASE_APART
  Spectrum phase = Spectrum(1.0);
#else
  Spectrum phase = phaseAlong(ray);
#endif
  return Airlight(phase, dot(boundary.xyz, ray.origin) + boundary.w, dot(boundary.xyz, ray.direction));
}

void litRange(Airlight light, inout float s0, inout float s1) {}

float steadyLength(Airlight light, float s) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return 0.1 / max(sigma * (1.0 + abs(light.pathSlope)), 1e-30);
}

float evenLength(Airlight light, float most) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return most / max(sigma * (1.0 + abs(light.pathSlope)), 1e-30);
}

Spectrum exponentialSpan(float e0, float slope, float len) {
  Spectrum sigma = SPECTRUM(extinction);
  float start = slope < 0.0 ? e0 + slope * len : e0;
  return exp(-sigma * start) * relativeExpm1(sigma * (abs(slope) * len)) * len;
}

Spectrum airlight(Airlight light, float s0, float s1) {
  float crossing = light.pathSlope != 0.0 ? -light.path / light.pathSlope : -1.0;
  Spectrum sum = Spectrum(0.0);
  float from = s0;
  for (int i = 0; i < 2 && from < s1; ++i) {
    float to = crossing > from && crossing < s1 ? crossing : s1;
    float path = light.path + from * light.pathSlope, middle = light.path + 0.5 * (from + to) * light.pathSlope;
    bool attenuated = middle > 0.0;
    sum += exponentialSpan(from + (attenuated ? max(path, 0.0) : 0.0), attenuated ? 1.0 + light.pathSlope : 1.0, to - from);
    from = to;
  }
  return light.phase * sum;
}

#else

struct Airlight {
  float foot;    // s of the point of the ray that is closest to the light
  float height2; // squared distance of the ray to the light
#if LIGHT_KIND == 2
  float axisFoot, axisSlope; // dot(axis, point - light) = axisFoot + (s - foot) axisSlope
  float axisDistance;        // |det(light - eye, ray, axis)|: b^2 + h^2 A = h^2 sin^2 - axisDistance^2, where less cancels
  vec3 sineFoot, sineSlope;  // cross(axis, point - light), likewise
  vec2 lit, inner;           // intervals of s inside the outer and inside the inner cone
#endif
};

float evenLength(Airlight light, float most) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return min(0.5 * most / max(sigma, 1e-30), (LIGHT_KIND == 2 && outerCosine >= 0.0 ? 0.25 : 1.0) * most * sqrt(light.height2));
}

#if LIGHT_KIND == 2
vec2 coneInterval(Airlight light, vec2 cosSinSquared) {
  const vec2 kNone = vec2(1.0, -1.0);
  const float kFar = 1e30;
  float b = light.axisFoot, v = light.axisSlope, c = cosSinSquared.x;
  if (c < 1e-4) { // a half-space: both nappes touch and the squared form has a double root; c < 0: a point light's open cone
    if (v == 0.0 || c < 0.0) return b > 0.0 || c < 0.0 ? vec2(-kFar, kFar) : kNone;
    return v > 0.0 ? vec2(-b / v, kFar) : vec2(-kFar, -b / v);
  }
  bool narrow = cosSinSquared.y < 0.5;
  float A = narrow ? cosSinSquared.y - dot(light.sineSlope, light.sineSlope) : v * v - c * c;
  float C = narrow ? cosSinSquared.y * light.height2 - dot(light.sineFoot, light.sineFoot) : b * b - c * c * light.height2;
  if (light.height2 <= 1.01e-13 * light.foot * light.foot) return A < 0.0 ? kNone : v > 0.0 ? vec2(0.0, kFar) : vec2(-kFar, 0.0);
  float B = narrow ? -dot(light.sineFoot, light.sineSlope) : b * v;
  float discriminant = c * c * (cosSinSquared.y * light.height2 - light.axisDistance * light.axisDistance);
  if (!(discriminant > 0.0)) return kNone;
  float q = -(B + (B < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
  float r0 = abs(A) > abs(q) * 1e-30 ? q / A : kFar * sign(q) * (A < 0.0 ? -1.0 : 1.0);
  float r1 = q != 0.0 ? C / q : 0.0;
  float low = min(r0, r1), high = max(r0, r1);
  if (A >= 0.0) return v > 0.0 ? vec2(high, kFar) : vec2(-kFar, low);
  return b + 0.5 * (low + high) * v > 0.0 ? vec2(low, high) : kNone;
}

float coneFalloff(Airlight light, float t, float r) {
  if (falloffScale == 0.0) return 1.0; // a hard edge: the span ends at it
  float cosine = (light.axisFoot + t * light.axisSlope) / r;
  float difference = cosine - outerCosine;
  if (outerSineSquared < 0.5) {
    vec3 sine = (light.sineFoot + t * light.sineSlope) / r;
    difference = (outerSineSquared - dot(sine, sine)) / (cosine + outerCosine);
  }
  float falloff = clamp(difference * falloffScale, 0.0, 1.0);
  return falloff * falloff;
}
#endif

Airlight airlightOf(Ray ray) {
  vec3 toLight = lightPosition - ray.origin;
  Airlight light;
  light.foot = dot(toLight, ray.direction);
  vec3 normal = cross(toLight, ray.direction);
  light.height2 = max(dot(normal, normal), max(1e-13 * dot(toLight, toLight), 1e-36));
#if LIGHT_KIND == 2
  vec3 footFromLight = ray.direction * light.foot - toLight;
  light.axisFoot = dot(lightDirection, footFromLight);
  light.axisSlope = dot(lightDirection, ray.direction);
  light.sineFoot = cross(lightDirection, footFromLight);
  light.sineSlope = cross(lightDirection, ray.direction);
  light.axisDistance = dot(lightDirection, cross(light.sineFoot, light.sineSlope));
  light.lit = light.foot + coneInterval(light, vec2(outerCosine, outerSineSquared));
  light.inner = light.foot + coneInterval(light, vec2(innerCosine, innerSineSquared));
#endif
  return light;
}

void litRange(Airlight light, inout float s0, inout float s1) {
  float range = lightRange;
  if (range > 0.0) {
    float halfChord = sqrt(max(0.0, range * range - light.height2));
    if (halfChord == 0.0) s1 = s0;
    s0 = max(s0, light.foot - halfChord);
    s1 = min(s1, light.foot + halfChord);
  }
#if LIGHT_KIND == 2
  s0 = max(s0, light.lit.x);
  s1 = min(s1, light.lit.y);
#endif
}


float panelLength(float t0, float r0, float t1, float r1, float len, float height2) {
  float y = t0 * t1 > 0.0 ? len * ((t1 + t0) / (t1 * r0 + r1 * t0)) : (t1 * r0 - r1 * t0) / height2;
  y = min(y, 1e30);
  if (y < 0.3) {
    float y2 = y * y;
    return y * (1.0 + y2 * (-1.0 / 6.0 + y2 * (3.0 / 40.0 + y2 * (-15.0 / 336.0 + y2 * (105.0 / 3456.0)))));
  }
  return y > 1e6 ? log(2.0 * y) : log(y + sqrt(1.0 + y * y));
}

Spectrum pointIntegrand(Airlight light, float P, float N, float start, float P0) {
  float r = 0.5 * (P + N);
  Spectrum value = phaseTowardsEye(P / r, N / r) * exp(-SPECTRUM(extinction) * (start + (P - P0))) / r;
#if LIGHT_KIND == 2
  value *= coneFalloff(light, 0.5 * (P - N), r);
#endif
  return value;
}

const float kNode6[3] = float[3](0.2386191860831969, 0.6612093864662645, 0.9324695142031521);
const float kWeight6[3] = float[3](0.4679139345726910, 0.3607615730481386, 0.1713244923791704);
const float kNode2 = 0.5773502691896257;

Spectrum pointPiece(Airlight light, float s0, float s1) {
  const int kMaxPanels = 32;
  const float kDark = 20.0; // optical depths beyond the start after which nothing counts
  float t0 = s0 - light.foot, t1 = s1 - light.foot;
  float r0 = sqrt(t0 * t0 + light.height2), r1 = sqrt(t1 * t1 + light.height2);
  float P0 = t0 > 0.0 ? r0 + t0 : light.height2 / (r0 - t0);
  float N0 = t0 > 0.0 ? light.height2 / (r0 + t0) : r0 - t0;
  float remaining = panelLength(t0, r0, t1, r1, s1 - s0, light.height2);
#if LIGHT_KIND == 2
  const float longPanel = 1.0; // the falloff's poles at |Im x| = pi/2 are of fourth order
  float shortPanel = falloffScale == 0.0 ? 0.2 : min(falloffPanel, 0.05 * (light.lit.y - light.lit.x) / max(r0, r1));
#else
  const float longPanel = 2.0, shortPanel = 0.2;
#endif
  float start = s0 + r0;
  vec3 sigma = extinction;
  Spectrum sum = Spectrum(0.0);
  float P = P0, N = N0;
  for (int i = 0; i < kMaxPanels && remaining > 0.0; ++i) {
    vec3 passed = sigma * (P - P0);
    bvec3 dark = greaterThan(passed, vec3(kDark));
    if (all(dark)) break;
    vec3 alive = mix(sigma, vec3(0.0), dark);
    float rate = max(alive.r, max(alive.g, alive.b)) * P;
    float len = i == kMaxPanels - 1 ? remaining : min(remaining, min(longPanel, rate > 0.0 ? log(1.0 + 6.0 / rate) : longPanel));
    float halfLength = 0.5 * len;
    float middle = exp(halfLength);
    float Pm = P * middle, Nm = N / middle;
    bool isShort = len < shortPanel && rate * len < 0.3;
    for (int k = 0; k < (isShort ? 1 : 3); ++k) {
      float step = exp(halfLength * (isShort ? kNode2 : kNode6[k]));
      sum += (halfLength * (isShort ? 1.0 : kWeight6[k])) * (pointIntegrand(light, Pm / step, Nm * step, start, P0) +
                                                             pointIntegrand(light, Pm * step, Nm / step, start, P0));
    }
    P = Pm * middle;
    N = Nm / middle;
    remaining -= len;
  }
  return sum;
}

Spectrum airlight(Airlight light, float s0, float s1) {
#if LIGHT_KIND == 2
  Spectrum sum = Spectrum(0.0);
  float from = s0;
  for (int i = 0; i < 3 && from < s1; ++i) {
    float to = s1;
    if (light.inner.x < light.inner.y) {
      if (light.inner.y > from && light.inner.y < to) to = light.inner.y;
      if (light.inner.x > from && light.inner.x < to) to = light.inner.x;
    }
    sum += pointPiece(light, from, to);
    from = to;
  }
  return sum;
#else
  return pointPiece(light, s0, s1);
#endif
}

#endif


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


uniform sampler2D lowRankRays;   // grid x terms: the ray's factors
uniform sampler2D lowRankLights; // sets x (2 terms grid): prefix sums, then the light's factors

const int kLowRankGrid = 64, kMostTerms = 8;

struct LowRankRay {
  bool valid;      // else it is too near to the direction of a light for the grid
  int set;
  float scale;     // directional: x = s scale; lamp: half a turn less beta
  Spectrum factor;
  Spectrum terms[kMostTerms];
} lowRank;

void startLowRank(Ray ray, int slice) {
  Airlight light = airlightOf(ray);
#if LIGHT_KIND == 0
  lowRank.scale = length(cross(lightDirection, ray.direction));
  float place = (log(max(lowRank.scale, 1e-30)) - lowRankRayBegin) * lowRankRayScale;
  lowRank.valid = place >= -0.01;
  lowRank.factor = light.phase / max(lowRank.scale, 1e-30);
#else
  float beta = atan(sqrt(light.height2), light.foot), place = (beta - lowRankRayBegin) * lowRankRayScale;
  lowRank.scale = 1.5707963267948966 - beta;
  lowRank.valid = true;
  lowRank.factor = Spectrum(inversesqrt(light.height2));
#endif
  lowRank.set = lowRankPerSlice != 0 ? slice : 0;
  int low = clamp(int(place), 0, kLowRankGrid - 2);
  float f = clamp(place - float(low), 0.0, 1.0);
  for (int i = 0; i < kMostTerms; ++i) {
    lowRank.terms[i] = Spectrum(0.0);
    if (i < lowRankTerms)
      lowRank.terms[i] = mix(SPECTRUM(texelFetch(lowRankRays, ivec2(low, i), 0)), SPECTRUM(texelFetch(lowRankRays, ivec2(low + 1, i), 0)), f);
  }
}

#if LIGHT_KIND == 0
vec3 placeOfLight(float x) {
  float last = float(kLowRankGrid - 1);
  x = clamp(x, 0.0, lowRankLightExtent);
  float cell = clamp(floor(last * pow(x / lowRankLightExtent, 1.0 / 3.0)), 0.0, last - 1.0);
  float unit = lowRankLightExtent / (last * last * last), begin = cell * cell * cell * unit;
  float len = (3.0 * cell * (cell + 1.0) + 1.0) * unit;
  return vec3(cell, clamp((x - begin) / len, 0.0, 1.0), len);
}

vec3 lightPlace(Airlight light, float s) { return placeOfLight(s * lowRank.scale); }
#else
vec3 placeOfLight(float gamma) {
  float last = float(kLowRankGrid - 1), at = clamp((gamma - lowRankLightBegin) / lowRankLightExtent * last, 0.0, last);
  float cell = min(floor(at), last - 1.0);
  return vec3(cell, at - cell, lowRankLightExtent / last);
}

vec3 lightPlace(Airlight light, float s) {
  return placeOfLight(atan((s - light.foot) * inversesqrt(light.height2)) + lowRank.scale);
}
#endif

Spectrum prefixSum(int term, vec3 place) {
  ivec2 at = ivec2(lowRank.set, 2 * term * kLowRankGrid + int(place.x)), slopes = at + ivec2(0, kLowRankGrid);
  Spectrum c0 = SPECTRUM(texelFetch(lowRankLights, at, 0)), c1 = SPECTRUM(texelFetch(lowRankLights, at + ivec2(0, 1), 0));
  Spectrum g0 = place.z * SPECTRUM(texelFetch(lowRankLights, slopes, 0)), g1 = place.z * SPECTRUM(texelFetch(lowRankLights, slopes + ivec2(0, 1), 0));
  float q = place.y;
  return c0 + q * (g0 + q * (3.0 * (c1 - c0) - 2.0 * g0 - g1 + q * (2.0 * (c0 - c1) + g0 + g1)));
}

Spectrum lowRankAirlight(Airlight light, float s0, float s1) {
  if (!lowRank.valid) return airlight(light, s0, s1);
  if (!(s1 > s0)) return Spectrum(0.0);
  vec3 from = lightPlace(light, s0), to = lightPlace(light, s1);
  Spectrum sum = Spectrum(0.0);
  for (int i = 0; i < kMostTerms; ++i)
    if (i < lowRankTerms) sum += lowRank.terms[i] * (prefixSum(i, to) - prefixSum(i, from));
  return lowRank.factor * sum;
}

#define airlight lowRankAirlight


uniform sampler2D rowDepths; // its height: rows that a draw has room for

layout(location = 0) out vec4 outRed;
layout(location = 1) out vec4 outGreen;
layout(location = 2) out vec4 outBlue;

vec3 tintAt(vec2 p, int view) {
  ivec2 last = shadowMapSize - 1;
#if FILTER_BILINEAR
  ivec2 cell = clamp(ivec2(floor(p - 0.5)), ivec2(-1), last), low = max(cell, ivec2(0)), high = min(cell + 1, last);
  vec2 f = clamp(p - 0.5 - vec2(cell), 0.0, 1.0);
  return mix(mix(paneTint(low, view), paneTint(ivec2(high.x, low.y), view), f.x),
             mix(paneTint(ivec2(low.x, high.y), view), paneTint(high, view), f.x), f.y);
#else
  return paneTint(clamp(ivec2(floor(p)), ivec2(0), last), view);
#endif
}

Ray referenceRay(int slice) {
  vec4 ends = sliceEnds(slice);
  Ray a = cameraRay(ends.xy), b = cameraRay(ends.zw);
  vec3 toLight = LIGHT_KIND == 0 ? lightDirection : lightPosition;
  vec3 sineA = cross(toLight, a.direction), sineB = cross(toLight, b.direction);
  if (dot(sineA, sineA) > dot(sineB, sineB)) return a;
  return b;
}

vec3 placeAt(Ray reference, int view, vec4 row, float index) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(reference.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(reference.direction, 0.0);
  vec2 along = row.zw / dot(row.zw, row.zw);
  float at = index + dot(row.xy, along), p = at * a.w - dot(a.xy, along), q = dot(b.xy, along) - at * b.w;
  float sine = length(cross(LIGHT_KIND == 0 ? lightDirection : normalize(lightPosition), reference.direction));
#if LIGHT_KIND == 0
  return placeOfLight(abs(q) > 0.0 ? p / q * sine : 0.0);
#else
  float lamp = length(lightPosition), y = p * sine, x = q * lamp - p * dot(lightPosition, reference.direction) / lamp;
  return placeOfLight(y < 0.0 ? atan(-y, -x) : atan(y, x));
#endif
}

void main() {
  int fours = (lowRankTerms + 3) / 4, rows = textureSize(rowDepths, 0).y, four = int(gl_FragCoord.y) / rows, row = int(gl_FragCoord.y) % rows;
  int view = viewOfRow(row), slice = sliceOfRow(row), first = 4 * int(gl_FragCoord.x);
  outRed = outGreen = outBlue = vec4(0.0);
  if (row >= sliceCount * max(drawnViews, 1) || first >= rowTexels(view, slice)) return;
  vec4 line = rowLine(view, slice);
  Ray reference = referenceRay(slice);
  lowRank.set = lowRankPerSlice != 0 ? slice : 0;
  vec3 place = placeAt(reference, view, line, float(first));
  for (int k = 1; k <= 4; ++k) {
    vec3 next = placeAt(reference, view, line, float(first + k)), tint = tintAt(line.xy + line.zw * (float(first + k) - 0.5), view);
    for (int i = 0; i < 4; ++i) {
      int term = 4 * four + i;
      if (term >= lowRankTerms) continue;
      vec3 light = tint * vec3(prefixSum(term, next) - prefixSum(term, place));
      outRed[i] += light.r;
      outGreen[i] += light.g;
      outBlue[i] += light.b;
    }
    place = next;
  }
}
