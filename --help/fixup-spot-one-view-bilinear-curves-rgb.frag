#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
#define LIGHT_KIND 2
#define SHADOW_VIEWS 1
#define SHADOW_ARRAY 0
#define FILTER_BILINEAR 1
#define GLASS 0
#define CURVES 1
#define MONOCHROME 0
// Fix-up: the pixels that unwarp left, each along its own line, with the pair tree of the slices on both sides of it; one
#define SKIPS_NODES

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


uniform sampler2D sceneDepth;

float depthAt(ivec2 pixel) { return texelFetch(sceneDepth, pixel, 0).r; }


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


#if GLASS
#define Visibility vec3 // fraction of the light that passes, per channel
#define Light vec3
#else
#define Visibility float
#define Light Spectrum
#endif

#define FADES (SHADOW_VIEWS == 2 && LIGHT_KIND == 0) // cascades may fade into one another

#if SHADOW_VIEWS > 0


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


struct ViewSegment {
  int view;
  float s0, s1;
  float w0, w1; // homogeneous weights at the ends, > 0
  vec3 p0, p1;
#if FADES
  vec2 share; // of the light at s0 and s1 that the view decides on; linear between
#endif
#if CURVES
  vec2 curveDepth; // linear depth at s0 and s1
#endif
};

void clipInterval(float c, float d, inout float s0, inout float s1) {
  if (d == 0.0) {
    if (c < 0.0) s1 = -1.0;
    return;
  }
  float s = -c / d;
  if (d > 0.0) s0 = max(s0, s);
  else s1 = min(s1, s);
}

vec2 viewInterval(int view, Ray ray, float s0, float s1, bool beforeNear) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec2 size = vec2(shadowMapSize);
  vec4 margin = shadowViews[view].margin;
  clipInterval(a.x + margin.x, b.x + margin.z, s0, s1);
  clipInterval(a.y + margin.y, b.y + margin.w, s0, s1);
  clipInterval(size.x * a.w - a.x + margin.x, size.x * b.w - b.x + margin.z, s0, s1);
  clipInterval(size.y * a.w - a.y + margin.y, size.y * b.w - b.y + margin.w, s0, s1);
  float c = a.z - shadowViews[view].nearDepth * a.w, d = b.z - shadowViews[view].nearDepth * b.w;
  clipInterval(beforeNear ? -c : c, beforeNear ? -d : d, s0, s1);
  if (shadowViews[view].isOpen == 0) clipInterval(shadowViews[view].farDepth * a.w - a.z, shadowViews[view].farDepth * b.w - b.z, s0, s1);
  return vec2(s0, s1);
}

ViewSegment viewSegment(int view, Ray ray, float s0, float s1, vec2 share) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec4 q0 = a + s0 * b, q1 = a + s1 * b;
  ViewSegment segment;
  segment.view = view;
  segment.s0 = s0;
  segment.s1 = s1;
  segment.w0 = q0.w;
  segment.w1 = q1.w;
  segment.p0 = q0.xyz / q0.w;
  segment.p1 = q1.xyz / q1.w;
#if FADES
  segment.share = share;
#endif
#if CURVES
  segment.curveDepth.x = dot(shadowViews[view].curveDepth.xyz, ray.origin + s0 * ray.direction) + shadowViews[view].curveDepth.w;
  segment.curveDepth.y = dot(shadowViews[view].curveDepth.xyz, ray.origin + s1 * ray.direction) + shadowViews[view].curveDepth.w;
#endif
  return segment;
}

float distanceAt(ViewSegment segment, float u) {
  float f = u * segment.w0 / (segment.w1 + u * (segment.w0 - segment.w1));
  return u >= 1.0 ? segment.s1 : segment.s0 + (segment.s1 - segment.s0) * f;
}


float langevin(float x) {
  if (x < 0.5) return x * (1.0 / 3.0 + x * x * (-1.0 / 45.0 + x * x * (2.0 / 945.0)));
  float e = exp(-2.0 * x);
  return (1.0 + e) / (1.0 - e) - 1.0 / x;
}
vec3 langevin(vec3 x) { return vec3(langevin(x.x), langevin(x.y), langevin(x.z)); }

#if LIGHT_KIND == 0
Light weightedLight(Airlight light, float s0, float s1, Visibility mean, Visibility moment) {
  bool attenuated = light.path + 0.5 * (s0 + s1) * light.pathSlope > 0.0;
  Spectrum fall = SPECTRUM(extinction) * ((attenuated ? 1.0 + light.pathSlope : 1.0) * (s1 - s0));
#if FADES || CURVES
  Spectrum towards = 3.0 * langevin(0.5 * abs(fall)) * sign(fall);
#else
  Spectrum towards = 0.5 * fall;
#endif
  return Light(airlight(light, s0, s1)) * (mean - moment * towards);
}
#else
Light weightedLight(Airlight light, float s0, float s1, Visibility mean, Visibility moment) {
  Light sum = Light(airlight(light, s0, s1));
  if (moment == Visibility(0.0)) return mean * sum;
  Light front = Light(airlight(light, s0, 0.5 * (s0 + s1)));
  return mean * sum + 2.0 * moment * (sum - 2.0 * front);
}
#endif

Light sharedLight(Airlight light, ViewSegment segment, float s0, float s1, Visibility mean, Visibility moment) {
#if FADES
  float scale = (segment.share.y - segment.share.x) / max(segment.s1 - segment.s0, 1e-30);
  float middle = segment.share.x + scale * (0.5 * (s0 + s1) - segment.s0), slope = 0.5 * scale * (s1 - s0);
  Visibility inShare = mean * middle + moment * slope;
  moment = moment * middle + mean * (slope / 3.0);
  mean = inShare;
#endif
  return weightedLight(light, s0, s1, mean, moment);
}

float parameterAt(ViewSegment segment, float s) {
  float f = (s - segment.s0) / max(segment.s1 - segment.s0, 1e-30);
  return f >= 1.0 ? 1.0 : segment.w1 * f / (segment.w0 * (1.0 - f) + segment.w1 * f);
}

#if CURVES

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

#endif

Light spanLight(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment) {
#if CURVES
  return curvedLight(light, segment, u0, u1, mean, moment);
#else
  return sharedLight(light, segment, distanceAt(segment, u0), distanceAt(segment, u1), mean, moment);
#endif
}


struct Line {
  vec3 origin, slope; // cell coordinates and depth at u are origin + u slope
  vec2 inverse;       // u per cell
  ivec2 direction;    // of the steps along x and y
  ivec2 last;         // cell
};

struct Walk {
  ivec2 cell;
  int left;       // cells to walk, this one included
  float u, depth; // and the receiver's depth there
  vec2 ahead;     // the next grid lines, relative to the line's origin
#ifdef SKIPS_NODES
  float stop;     // how far cells are looked at before nodes are again
#endif
};

void startWalk(ViewSegment segment, out Line line, out Walk walk) {
#if FILTER_BILINEAR
  const float kShift = 0.5;
  const int kLowest = -1; // the cell before the first centre
#else
  const float kShift = 0.0;
  const int kLowest = 0;
#endif
#ifdef SKIPS_NODES
  walk.stop = -1.0;
#endif
  line.origin = vec3(segment.p0.xy - kShift, segment.p0.z);
  vec3 end = vec3(segment.p1.xy - kShift, segment.p1.z);
  line.slope = end - line.origin;
  line.direction = ivec2(line.slope.x < 0.0 ? -1 : 1, line.slope.y < 0.0 ? -1 : 1);
  ivec2 highest = shadowMapSize - 1;
  line.last = clamp(ivec2(floor(end.xy)), ivec2(kLowest), highest);
  walk.cell = clamp(ivec2(floor(line.origin.xy)), ivec2(kLowest), highest);
  ivec2 extent = abs(line.last - walk.cell);
  walk.left = extent.x + extent.y + 1;
  walk.u = 0.0;
  walk.depth = line.origin.z;
  bvec2 moves = notEqual(extent, ivec2(0));
  walk.ahead = vec2(walk.cell + max(line.direction, ivec2(0))) - line.origin.xy;
  walk.ahead = mix(vec2(2.0), walk.ahead, moves);
  line.inverse = mix(vec2(1.0), 1.0 / line.slope.xy, moves);
}

float cellEnd(Line line, Walk walk) {
  vec2 next = walk.ahead * line.inverse;
  return walk.left == 1 ? 1.0 : clamp(min(next.x, next.y), walk.u, 1.0);
}

void stepCell(Line line, inout Walk walk, float u, float depth) {
  vec2 next = walk.ahead * line.inverse;
  ivec2 step = next.x < next.y ? ivec2(line.direction.x, 0) : ivec2(0, line.direction.y);
  walk.cell += step;
  walk.ahead += vec2(step);
  walk.u = u;
  walk.depth = depth;
  --walk.left;
}

#ifdef SKIPS_NODES

void enterCell(Line line, inout Walk walk, float u) {
  ivec2 cell = ivec2(floor(line.origin.xy + line.slope.xy * u));
  cell = clamp(cell, min(walk.cell, line.last), max(walk.cell, line.last));
  walk.ahead += vec2(cell - walk.cell);
  walk.cell = cell;
  ivec2 extent = abs(line.last - cell);
  walk.left = u < 1.0 ? extent.x + extent.y + 1 : 0;
  walk.u = u;
  walk.depth = line.origin.z + line.slope.z * u;
}

void skipNodes(Line line, Visibility current, inout Walk walk);

#endif

#if FILTER_BILINEAR

vec4 cornerWeights(Line line, ivec2 cell, float u) {
  vec2 f = line.origin.xy + line.slope.xy * u - vec2(cell), g = 1.0 - f;
  return vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
}

float firstCrossing(vec4 crossings, float u, float end) {
  vec4 ahead = mix(vec4(end), crossings, greaterThan(crossings, vec4(u)));
  return min(end, min(min(ahead.x, ahead.y), min(ahead.z, ahead.w)));
}

bool isUnchanged(ivec2 cell, int view, float depthIn, float depthOut, Visibility current) {
  vec4 depth = cornerDepths(cell, view);
  float nearer = min(depthIn, depthOut), farther = max(depthIn, depthOut);
  bool dark = all(lessThan(depth, vec4(nearer)));
  bool lit = all(greaterThanEqual(depth, vec4(farther)));
#if GLASS
  lit = lit && all(greaterThanEqual(cornerPanes(cell, view), vec4(farther)));
#endif
  return lit ? current == Visibility(1.0) : dark && current == Visibility(0.0);
}

Visibility pieceVisibility(Line line, ivec2 cell, int view, float u, inout float uEnd) {
  float inverseDepth = 1.0 / line.slope.z;
  vec4 depth = cornerDepths(cell, view);
  uEnd = firstCrossing((depth - line.origin.z) * inverseDepth, u, uEnd);
#if GLASS
  ivec2 last = shadowMapSize - 1, low = max(cell, ivec2(0)), high = min(cell + 1, last);
  vec3 tints[4] = vec3[4](paneTint(low, view), paneTint(ivec2(high.x, low.y), view), paneTint(ivec2(low.x, high.y), view),
                          paneTint(high, view));
  vec4 pane = cornerPanes(cell, view);
  bvec4 clear = bvec4(tints[0] == vec3(1.0), tints[1] == vec3(1.0), tints[2] == vec3(1.0), tints[3] == vec3(1.0));
  pane = mix(pane, vec4(3e38), clear); // clear glass is no glass
  uEnd = firstCrossing((pane - line.origin.z) * inverseDepth, u, uEnd);
#endif
  vec4 receiver = vec4(line.origin.z + line.slope.z * (0.5 * (u + uEnd)));
  bvec4 lit = greaterThanEqual(depth, receiver);
  float middle = 0.5 * (u + uEnd), node = 0.5773502691896257 * 0.5 * (uEnd - u);
  vec4 weights = 0.5 * (cornerWeights(line, cell, middle - node) + cornerWeights(line, cell, middle + node));
  vec4 litWeights = mix(vec4(0.0), weights, lit);
#if GLASS
  if (all(lit) && !any(lessThan(pane, receiver))) return vec3(1.0);
  bvec4 behind = lessThan(pane, receiver);
  return litWeights.x * (behind.x ? tints[0] : vec3(1.0)) + litWeights.y * (behind.y ? tints[1] : vec3(1.0)) +
         litWeights.z * (behind.z ? tints[2] : vec3(1.0)) + litWeights.w * (behind.w ? tints[3] : vec3(1.0));
#else
  return all(lit) ? 1.0 : dot(litWeights, vec4(1.0));
#endif
}

const int kPiecesPerCell = 5 + 4 * GLASS;

#else

bool isUnchanged(ivec2 cell, int view, float depthIn, float depthOut, Visibility current) {
  float depth = casterDepth(cell, view);
  bool litIn = depthIn <= depth, litOut = depthOut <= depth;
#if GLASS
  float pane = paneDepth(cell, view);
  bool behindIn = depthIn > pane, behindOut = depthOut > pane;
  vec3 visibility = litIn ? (behindIn ? paneTint(cell, view) : vec3(1.0)) : vec3(0.0);
  return litIn == litOut && (!litIn || behindIn == behindOut) && visibility == current;
#else
  return litIn == (current != 0.0) && litIn == litOut;
#endif
}

Visibility pieceVisibility(Line line, ivec2 cell, int view, float u, inout float uEnd) {
  float inverseDepth = 1.0 / line.slope.z;
  float depth = casterDepth(cell, view);
  float crossing = (depth - line.origin.z) * inverseDepth;
  if (crossing > u && crossing < uEnd) uEnd = crossing;
#if GLASS
  float pane = paneDepth(cell, view);
  crossing = (pane - line.origin.z) * inverseDepth;
  if (crossing > u && crossing < uEnd) uEnd = crossing;
  float receiver = line.origin.z + line.slope.z * (0.5 * (u + uEnd));
  return receiver <= depth ? (receiver > pane ? paneTint(cell, view) : vec3(1.0)) : vec3(0.0);
#else
  return line.origin.z + line.slope.z * (0.5 * (u + uEnd)) <= depth ? 1.0 : 0.0;
#endif
}

const int kPiecesPerCell = 2 + GLASS;

#endif

bool takeCell(Line line, int view, inout Walk walk, Visibility current) {
#ifdef SKIPS_NODES
  if (walk.u >= walk.stop) return false;
#endif
  float u = cellEnd(line, walk);
  float depth = line.origin.z + line.slope.z * u;
  if (walk.left <= 0 || !isUnchanged(walk.cell, view, walk.depth, depth, current)) return false;
  stepCell(line, walk, u, depth);
  return true;
}

Light segmentLight(Airlight light, ViewSegment segment) {
  int view = segment.view;
  Line line;
  Walk walk;
  startWalk(segment, line, walk);
  int pieces = (kPiecesPerCell + 2) * walk.left + 8 + 1000 * FILTER_BILINEAR;
  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  bool done = false;
  while (!done) {
    Visibility weight = Visibility(0.0);
    float begin = 0.0, end = 0.0;
    while (!done && weight == Visibility(0.0)) {
#ifdef SKIPS_NODES
      if (walk.u >= walk.stop) skipNodes(line, current, walk);
#endif
      bool walking = true;
      while (walking) {
        walking = takeCell(line, view, walk, current) && takeCell(line, view, walk, current) &&
                  takeCell(line, view, walk, current) && takeCell(line, view, walk, current);
      }
      done = walk.left <= 0 || pieces <= 0;
#ifdef SKIPS_NODES
      if (!done && walk.u >= walk.stop) {
        --pieces;
        continue;
      }
#endif
      float uCell = cellEnd(line, walk), uEnd = uCell;
#if FILTER_BILINEAR && LIGHT_KIND == 0
      float s = distanceAt(segment, walk.u);
      uEnd = clamp(parameterAt(segment, s + steadyLength(light, s)), walk.u, uCell);
      if (!(uEnd > walk.u)) uEnd = uCell;
#endif
      Visibility visibility = Visibility(0.0);
      if (!done) visibility = pieceVisibility(line, walk.cell, view, walk.u, uEnd);
      if (visibility != current) {
        weight = current;
        begin = from;
        end = walk.u;
        current = visibility;
        from = walk.u;
      }
      --pieces;
      float depth = line.origin.z + line.slope.z * uEnd;
      if (uEnd < uCell) {
        walk.u = uEnd;
        walk.depth = depth;
      } else {
        stepCell(line, walk, uEnd, depth);
      }
    }
#if FADES || CURVES
    sum += spanLight(light, segment, begin, end, weight, Visibility(0.0));
#else
    sum += Light(weight) * Light(airlight(light, distanceAt(segment, begin), distanceAt(segment, end)));
#endif
  }
  return sum;
}

#endif


#if SHADOW_VIEWS > 0
Light ownedLight(Airlight light, ViewSegment segment, int slice);
#endif

#ifndef FADE_STEPS
#define FADE_STEPS 1
#endif
const int kMostViews = SHADOW_VIEWS == 2 ? MAX_SHADOW_VIEWS : 1, kMostOwned = 2 * kMostViews;

const int kFadeSteps = SHADOW_VIEWS == 2 ? FADE_STEPS : 1; // pieces of a fade, over each of which the weight is a line
const int kCornerSteps = 4 * kFadeSteps; // where the weight comes and goes without having been 1
const int kMostPieces = (4 + kCornerSteps) * kFadeSteps * kMostViews;

#if FADES

vec2 wholeInterval(int view, Ray ray, float s0, float s1) {
  vec4 a = shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), b = shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0);
  vec2 inset = cascadeFade * vec2(shadowMapSize), end = vec2(shadowMapSize) - inset;
  clipInterval(a.x - inset.x * a.w, b.x - inset.x * b.w, s0, s1);
  clipInterval(a.y - inset.y * a.w, b.y - inset.y * b.w, s0, s1);
  clipInterval(end.x * a.w - a.x, end.x * b.w - b.x, s0, s1);
  clipInterval(end.y * a.w - a.y, end.y * b.w - b.y, s0, s1);
  float far = mix(shadowViews[view].farDepth, shadowViews[view].nearDepth, cascadeFade);
  if (shadowViews[view].isOpen == 0) clipInterval(far * a.w - a.z, far * b.w - b.z, s0, s1);
  return vec2(s0, s1);
}

float viewWeight(int view, Ray ray, float s) {
  vec4 q = shadowViews[view].texelFromCamera * vec4(ray.origin + s * ray.direction, 1.0);
  vec2 place = q.xy / (q.w * vec2(shadowMapSize)), side = min(place, 1.0 - place);
  float least = min(side.x, side.y), far = shadowViews[view].farDepth;
  if (shadowViews[view].isOpen == 0) least = min(least, (far - q.z / q.w) / (far - shadowViews[view].nearDepth));
  return clamp(least / cascadeFade, 0.0, 1.0);
}

int fadeInto(int owner, Ray ray, vec2 owned[kMostOwned], float s0, float s1, float s, inout float end, out vec2 weight) {
  int next = -1;
  weight = vec2(1.0);
  for (int i = owner + 1; i < viewCount && next < 0; ++i) {
    if (owned[i].y <= s || owned[i].y <= owned[i].x) continue;
    if (owned[i].x <= s) next = i;
    end = min(end, owned[i].x <= s ? owned[i].y : owned[i].x);
  }
  if (next < 0) return -1;
  vec2 whole = wholeInterval(owner, ray, s0, s1);
  bool hasWhole = whole.y > whole.x, before = hasWhole && s < whole.x, behind = hasWhole && s >= whole.y;
  if (hasWhole && !before && !behind) {
    end = min(end, whole.y);
    return -1;
  }
  float first = behind ? whole.y : owned[owner].x, last = before ? whole.x : owned[owner].y;
  end = min(min(end, last), s + max((last - first) / float(hasWhole ? kFadeSteps : kCornerSteps), 1e-6 * abs(s)));
  weight = vec2(viewWeight(owner, ray, s), viewWeight(owner, ray, end));
  return next;
}

#endif

Light shadowedLight(Airlight light, Ray ray, float s0, float s1, ivec2 views, bool outside, int slice) {
  if (!(s1 > s0)) return Light(0.0);
#if SHADOW_VIEWS == 0
  return Light(airlight(light, s0, s1));
#else
#if SHADOW_VIEWS == 1
  const int kViews = 1;
#else
  int kViews = viewCount;
#endif
  bool litOutside = isLitOutside != 0;
  vec2 owned[kMostOwned];
  int count = litOutside ? kViews : 2 * kViews;
  for (int i = 0; i < count; ++i) {
    vec2 interval = viewInterval(i < kViews ? i : i - kViews, ray, s0, s1, i >= kViews);
#define STORE(k) owned[k] = i == k ? interval : owned[k];
    STORE(0) STORE(1)
#if SHADOW_VIEWS == 2
    STORE(2) STORE(3) STORE(4) STORE(5) STORE(6) STORE(7) STORE(8) STORE(9) STORE(10) STORE(11)
#endif
  }
  Light sum = Light(0.0);
  float s = s0;
  int turn = 0; // of the two views that share a fade
  for (int guard = 0; guard < kMostPieces && s < s1; ++guard) {
    int view = -1;
    vec2 share = vec2(0.0);
    float from = s, to = s;
    for (int i = 0; i < kMostPieces && view < 0 && s < s1; ++i) {
      int owner = -1;
      float end = s1;
      for (int k = 0; k < count && owner < 0; ++k) {
        if (owned[k].y <= s || owned[k].y <= owned[k].x) continue;
        if (owned[k].x <= s) {
          owner = k;
          end = min(end, owned[k].y);
        } else {
          end = min(end, owned[k].x);
        }
      }
      bool inView = owner >= 0 && owner < kViews;
      int next = -1;
      vec2 weight = vec2(1.0);
#if FADES
      if (inView && cascadeFade > 0.0) next = fadeInto(owner, ray, owned, s0, s1, s, end, weight);
#endif
      if (outside && !inView && (owner >= 0 || litOutside)) sum += Light(airlight(light, s, end));
      int candidate = turn == 0 ? owner : next;
      share = turn == 0 ? weight : 1.0 - weight;
      if (inView && share != vec2(0.0) && candidate >= views.x && candidate < views.x + views.y) view = candidate;
      from = s;
      to = end;
      turn = turn == 0 && next >= 0 ? 1 : 0;
      s = turn == 1 ? s : end;
    }
    if (view >= 0) sum += ownedLight(light, viewSegment(view, ray, from, to, share), slice);
  }
  return sum;
#endif
}



#ifdef COUNT_VISITS
int visits = 0;
#define VISIT ++visits;
#else
#define VISIT
#endif

#if SHADOW_VIEWS > 0

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


uniform sampler2D rowDepths;
uniform sampler2D rowTree;
uniform sampler2D rowMeans; // averages, as split.glsl stores them
#if GLASS
uniform sampler2D rowMoments;
#endif

struct RowLine {
  vec2 origin, step; // of the row, texels
  float begin, inverse; // inverse: 1 / extent, or 0 if the ray does not move along the row
  float depth, slope;   // coded
  int row;  // where row textures hold it
  int last; // index of the last texel
  int firstWhole; // first texel that the ray crosses whole
#ifdef TINT_SUMS
  bool tintSums;  // the ray may use them
#endif
  int evenLevel;  // coarsest level at which a line stands for the airlight over a node
};

const int kMostEven = 4; // changedParts.frag counts on nodes of 256 texels at most to be taken by their averages

struct RowWalk {
  int index;
  float u, depth;
};

float rowDepth(RowLine line, float u) { return min(line.depth + line.slope * u, emptyRowCode); }

void startRow(Airlight light, ViewSegment segment, int slice, out RowLine line, out RowWalk walk) {
  vec4 row = rowLine(segment.view, slice);
  line.row = rowOf(segment.view, slice);
  line.origin = row.xy;
  line.step = row.zw;
#if CURVES && defined(ROW_CURVES)
  curveRow = CurveRow(isAlongX(row), (isAlongX(row) ? row.z : row.w) < 0.0, line.row);
#endif
  int highest = rowLast(segment.view, slice);
  float scale = 1.0 / dot(row.zw, row.zw);
  line.begin = dot(segment.p0.xy - row.xy, row.zw) * scale;
  float end = dot(segment.p1.xy - row.xy, row.zw) * scale;
  walk.index = clamp(int(floor(line.begin)), 0, highest);
  line.last = clamp(int(floor(end)), walk.index, highest);
  line.inverse = line.last > walk.index ? 1.0 / (end - line.begin) : 0.0;
  line.firstWhole = int(ceil(line.begin));
  float texel = (segment.s1 - segment.s0) * line.inverse * max(segment.w0 / segment.w1, segment.w1 / segment.w0);
  line.evenLevel = min(int(floor(0.5 * log2(clamp(evenLength(light, averageThreshold) / max(texel, 1e-30), 1.0, 1e9)))), kMostEven);
#ifdef TINT_SUMS
  line.tintSums = lowRank.valid;
#if FADES
  line.tintSums = lowRank.valid && segment.share == vec2(1.0);
#endif
#endif
  line.depth = segment.p0.z * rowCodeScale + rowCodeOffset;
  line.slope = (segment.p1.z - segment.p0.z) * rowCodeScale;
  walk.u = 0.0;
  walk.depth = rowDepth(line, 0.0);
}

float rowEnd(RowLine line, RowWalk walk, int index) {
  return index > line.last ? 1.0 : clamp((float(index) - line.begin) * line.inverse, walk.u, 1.0);
}

void advanceRow(RowLine line, inout RowWalk walk, int index, float u) {
  walk.index = index;
  walk.u = u;
  walk.depth = rowDepth(line, u);
}

const float kMixed = 0.5;

float boundsVisibility(float begin, float end, vec2 bounds) {
  return max(begin, end) <= bounds.x ? 1.0 : min(begin, end) > bounds.y ? 0.0 : kMixed;
}

const float kAverage = 2.0;

bool isAverage(RowLine line, RowWalk walk, int level, int next, float end, vec4 split) {
  bool inside = min(walk.depth, end) > split.y && max(walk.depth, end) <= split.z;
#if FILTER_BILINEAR || GLASS
  if (walk.u > (float(walk.index) - line.begin) * line.inverse + 1e-6 * line.inverse) return false; // within a texel
#endif
#ifdef TINT_SUMS
  return inside && line.tintSums && walk.index >= line.firstWhole && next <= line.last;
#endif
  return inside && level <= line.evenLevel && walk.index >= line.firstWhole && next <= line.last + 1;
}

Average averageAt(int node, int row) {
#if GLASS
  return averageOf(texelFetch(rowMeans, ivec2(node, row), 0), texelFetch(rowMoments, ivec2(node, row), 0));
#else
  return averageOf(texelFetch(rowMeans, ivec2(node, row), 0));
#endif
}

float walkNodes(RowLine line, inout RowWalk walk, float current, out int nodeEnd, out int average) {
  float found = kMixed;
  int level = 2, base = 0; // base: where the level begins
  bool walking = treeLevels > 0 && (walk.index & 15) == 0 && walk.index <= line.last;
  while (walking) {
    VISIT
    int node = walk.index >> (2 * level), next = (node + 1) << (2 * level);
    float u = rowEnd(line, walk, next), end = rowDepth(line, u);
    vec4 split = texelFetch(rowTree, ivec2(base + node, line.row), 0);
    found = boundsVisibility(walk.depth, end, split.xw);
#ifdef TINT_SUMS
    if (current == kAverage && isAverage(line, walk, level, next, end, split)) found = kAverage;
#endif
    nodeEnd = next;
    average = base + node;
    if (found == current) {
      walk = RowWalk(next, u, end);
      bool up = level < treeLevels && (next & ((4 << (2 * level)) - 1)) == 0;
      base += up ? rowLength >> (2 * level) : 0;
      level += up ? 1 : 0;
      walking = walk.index <= line.last;
    } else {
      if (found == kMixed && isAverage(line, walk, level, next, end, split)) found = kAverage;
      walking = found == kMixed && level > 2;
      --level;
      base -= walking ? rowLength >> (2 * level) : 0;
    }
  }
  return found;
}

#if FILTER_BILINEAR || GLASS

uniform sampler2D rowShares; // the groups' means

Visibility texelVisibility(RowLine line, RowWalk walk, ViewSegment segment, inout float u) {
  VISIT
  vec2 p = line.origin + line.step * (float(walk.index) + 0.5);
#if FILTER_BILINEAR
  p -= 0.5;
#endif
  Line still;
  still.origin = vec3(p, segment.p0.z);
  still.slope = vec3(0.0, 0.0, segment.p1.z - segment.p0.z);
  ivec2 cell = clamp(ivec2(floor(p)), ivec2(FILTER_BILINEAR == 1 ? -1 : 0), shadowMapSize - 1);
  return pieceVisibility(still, cell, segment.view, walk.u, u);
}

bool takeGroup(RowLine line, inout RowWalk walk, float current, out bool averaged) {
  VISIT
  int next = ((walk.index >> 2) + 1) << 2;
  float u = rowEnd(line, walk, next), end = rowDepth(line, u);
  vec4 split = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  float found = boundsVisibility(walk.depth, end, split.xw);
  averaged = (found == kMixed || current == kAverage) && (walk.index & 3) == 0 && isAverage(line, walk, 1, next, end, split);
#ifdef TINT_SUMS
  if (averaged && current == kAverage) found = kAverage;
#endif
  if (walk.index > line.last || found != current) return false;
  walk = RowWalk(next, u, end);
  return true;
}

const Visibility kTinted = Visibility(-1.0);

Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  int guard = (8 + 4 * GLASS) * (line.last - walk.index + 1) + 16; // bounds the loops whatever the arithmetic does
  Light sum = Light(0.0);
  Visibility current = Visibility(0.0);
  float from = 0.0;
  int first = 0; // index where the stretch begins
  bool done = false;
  while (!done) {
    Average weight = Average(Visibility(0.0), Visibility(0.0));
    vec2 span = vec2(0.0);
    ivec2 indices = ivec2(0);
    while (!done && weight.mean == Visibility(0.0)) {
      float state = current == kTinted ? kAverage : current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
      int averageEnd = 0, average = 0, nodeEnd;
      float found = walkNodes(line, walk, state, averageEnd, average);
      nodeEnd = ((walk.index >> 4) + 1) << 4;
      bool taking = treeLevels > 0 && found == kMixed, groupAveraged = false;
      while (taking) taking = takeGroup(line, walk, state, groupAveraged) && walk.index < nodeEnd;
      done = walk.index > line.last || guard <= 0;
      groupAveraged = groupAveraged && !done && walk.index < nodeEnd;
      bool averaged = !done && (found == kAverage || groupAveraged);
      float uTexel = rowEnd(line, walk, walk.index + 1), u = uTexel;
      bool look = !done && !averaged && walk.index < nodeEnd; // else the next node's turn
      Visibility visibility = current;
      if (look) visibility = found != kMixed ? Visibility(found) : texelVisibility(line, walk, segment, u);
#ifdef TINT_SUMS
      if (averaged) visibility = kTinted;
      else
#endif
      if (done || averaged) visibility = Visibility(0.0);
      if (visibility != current) {
        weight.mean = current;
        span = vec2(from, walk.u);
        indices = ivec2(first, walk.index);
        current = visibility;
        from = walk.u;
        first = walk.index;
      }
#ifndef TINT_SUMS
      else if (averaged) {
        int next = groupAveraged ? walk.index + 4 : averageEnd;
        weight.mean = Visibility(texelFetch(rowShares, ivec2(walk.index >> 2, line.row), 0).rgb);
        if (!groupAveraged) weight = averageAt(average, line.row);
        span = vec2(walk.u, rowEnd(line, walk, next));
        advanceRow(line, walk, next, span.y);
        from = walk.u;
        done = walk.index > line.last;
      }
#endif
      --guard;
      if (look && found == kMixed) {
        if (u < uTexel) advanceRow(line, walk, walk.index, u);
        else advanceRow(line, walk, walk.index + 1, uTexel);
      }
    }
#ifdef TINT_SUMS
    if (weight.mean == kTinted) {
      sum += tintedLight(line.row, indices.x, indices.y);
      continue;
    }
#endif
    sum += spanLight(light, segment, span.x, span.y, weight.mean, weight.moment);
  }
  return sum;
}

#else

bool changeInGroup(RowLine line, inout RowWalk walk, bool lit, inout float at) {
  VISIT
  vec4 depths = texelFetch(rowDepths, ivec2(walk.index >> 2, line.row), 0);
  int first = walk.index & ~3;
  bool changed = false;
  for (int k = 0; k < 4; ++k) {
    float u = rowEnd(line, walk, first + k + 1), end = rowDepth(line, u);
    bool litIn = walk.depth <= depths[k], litOut = end <= depths[k];
    bool here = !changed && first + k == walk.index && walk.index <= line.last;
    changed = changed || (here && (litIn != lit || litOut != lit));
    if (here && litIn != lit) at = walk.u;
    if (here && litIn == lit) {
      if (changed) at = clamp((depths[k] - line.depth) / line.slope, walk.u, u);
      walk = RowWalk(first + k + 1, u, end);
    }
  }
  return changed;
}

Light rowLight(Airlight light, ViewSegment segment, int slice) {
  RowLine line;
  RowWalk walk;
  startRow(light, segment, slice, line, walk);
  Light sum = Light(0.0);
  bool lit = false, done = false;
  float from = 0.0;
  while (!done) {
    vec2 span = vec2(0.0);
    Average weight = Average(1.0, 0.0);
    while (!done && span.y == 0.0) {
      int nodeEnd = 0, average = 0;
      float found = walkNodes(line, walk, lit ? 1.0 : 0.0, nodeEnd, average), at = walk.u;
      done = walk.index > line.last;
      bool averaged = !done && !lit && found == kAverage, changed = !done && !averaged && found != kMixed;
      if (averaged) {
        float u = rowEnd(line, walk, nodeEnd);
        span = vec2(walk.u, u);
        weight = averageAt(average, line.row);
        advanceRow(line, walk, nodeEnd, u);
        done = walk.index > line.last;
      } else if (!done && !changed) {
        changed = changeInGroup(line, walk, lit, at);
      }
      if (lit && (changed || done)) span = vec2(from, done ? 1.0 : at);
      if (changed) {
        lit = !lit;
        from = at;
      }
    }
    sum += spanLight(light, segment, span.x, span.y, weight.mean, weight.moment);
  }
  return sum;
}

#endif

#endif


#if SHADOW_VIEWS > 0

RowLine trueRow; // of the slice on one side of the ray

void skipNodes(Line line, Visibility current, inout Walk walk) {
  walk.stop = 2.0;
  if (treeLevels == 0) return;
  float state = current == Visibility(1.0) ? 1.0 : current == Visibility(0.0) ? 0.0 : -1.0;
  float extent = trueRow.inverse > 0.0 ? 1.0 / trueRow.inverse : 0.0;
  RowWalk at = RowWalk(clamp(int(floor(trueRow.begin + walk.u * extent)), 0, trueRow.last), walk.u, rowDepth(trueRow, walk.u));
  int level = 1, base = 0;
  bool walking = walk.left > 0;
  while (walking) {
    int node = at.index >> (2 * level), next = (node + 1) << (2 * level);
    float u = rowEnd(trueRow, at, next);
    float found = boundsVisibility(at.depth, rowDepth(trueRow, u), texelFetch(rowTree, ivec2(base + node, trueRow.row), 0).rg);
    if (found == state) {
      advanceRow(trueRow, at, next, u);
      bool up = level < treeLevels && (next & ((4 << (2 * level)) - 1)) == 0;
      base += up ? rowLength >> (2 * level) : 0;
      level += up ? 1 : 0;
      walking = at.index <= trueRow.last;
    } else {
      walking = found == kMixed && level > 1;
      --level;
      base -= walking ? rowLength >> (2 * level) : 0;
    }
  }
  if (at.u > walk.u) enterCell(line, walk, at.u);
  int end = ((at.index >> 2) + 1) << 2;
  walk.stop = rowEnd(trueRow, at, end);
  if (walk.stop <= walk.u) walk.stop = rowEnd(trueRow, at, end + 4); // rounding left the walk a step behind
  if (walk.stop >= 1.0) walk.stop = 2.0; // the line's last cells, however they round
}

Light ownedLight(Airlight light, ViewSegment segment, int slice) {
  RowWalk unused;
  startRow(light, segment, slice, trueRow, unused);
  return segmentLight(light, segment);
}

#endif


#if SHADOW_VIEWS > 0 && !defined(SKIPS_NODES)
Light ownedLight(Airlight light, ViewSegment segment, int slice) { return rowLight(light, segment, slice); }
#endif

Light rowShadowedLight(Ray ray, float from, float end, int slice) {
  Airlight light = airlightOf(ray);
  float s0 = from, s1 = min(end, visibleEnd);
  litRange(light, s0, s1);
  return shadowedLight(light, ray, s0, s1, ivec2(firstView, drawnViews), bringsOutside != 0, slice);
}


float lampSine(Ray ray) {
#if LIGHT_KIND == 0
  return 1.0;
#else
  if (epipoleSign < 0.0) return 1.0; // behind the camera the inscatter stays finite
  vec3 toLight = lightPosition - ray.origin, normal = cross(toLight, ray.direction);
  float square = dot(toLight, toLight);
  return square > 0.0 ? sqrt(max(dot(normal, normal) / square, 1e-13)) : 1.0; // the floor of airlightOf
#endif
}

vec3 storedLight(Light light, Ray ray) {
#if MONOCHROME && !GLASS
  return vec3(light) * lampSine(ray);
#else
  return min(storedScale * vec3(light) * lampSine(ray), vec3(65504.0));
#endif
}

float endCoordinate(Ray ray, float end) {
  float coordinate = log2(max(end, 1e-30));
#if LIGHT_KIND != 0
  vec3 toLight = lightPosition - ray.origin;
  coordinate += atan(end - dot(toLight, ray.direction), max(length(cross(toLight, ray.direction)), 1e-30));
#endif
  return coordinate;
}

const float kCoordinateSteps = 1280.0; // of a unit
const int kHalfLeast = 113 << 10, kHalfCount = 30 << 10; // bits of the normal half floats as a float has them, >> 13

float halfOfCoordinate(float coordinate) {
  int code = int(clamp((coordinate - leastCoordinate) * kCoordinateSteps + 0.5, 0.0, float(2 * kHalfCount - 1)));
  float size = intBitsToFloat((kHalfLeast + code % kHalfCount) << 13);
  return code < kHalfCount ? -size : size;
}

float coordinateOfHalf(float value) {
  int code = (floatBitsToInt(abs(value)) >> 13) - kHalfLeast + (value < 0.0 ? 0 : kHalfCount);
  return float(code) / kCoordinateSteps + leastCoordinate;
}

vec4 storedWithCoordinate(vec3 light, float coordinate) {
#if MONOCHROME && !GLASS
  return vec4(light.r, coordinate, 0.0, 0.0);
#else
  return vec4(light, halfOfCoordinate(coordinate));
#endif
}

float storedCoordinate(vec4 texel) {
#if MONOCHROME && !GLASS
  return texel.g;
#else
  return coordinateOfHalf(texel.a);
#endif
}



layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  int slice = neighbourSlices(sliceCoordinate(gl_FragCoord.xy)).x;
  vec3 light = vec3(rowShadowedLight(cameraRay(gl_FragCoord.xy), 0.0, end, slice));
  outInscatter = vec4(min(lightColour * light, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(transmittanceTo(end), 1.0);
}
