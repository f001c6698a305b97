#version 330 core
#define LIGHT_KIND 0
#define SHADOW_VIEWS 1
#define SHADOW_ARRAY 0
#define GLASS 1
#define COMPOSITE 0
#define BOUNDARY 1
#define MONOCHROME 1
#define FILTER_BILINEAR 0
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Fixed steps: the inscatter of one light at every pixel, jittered by interleaved gradient noise.
// Reads the scene depth and the light's maps. Writes inscatter, added up over the lights, and transmittance.
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
// Camera rays from the engine's depth (DESIGN: rule 1; the matrices are composed in double on the CPU).

struct Ray {
  vec3 origin;    // eye, or the point on the near plane of an orthographic camera
  vec3 direction; // unit
};

// The ray through a window position (pixels, as gl_FragCoord.xy).
Ray cameraRay(vec2 windowPosition) {
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec3 far = farPoint[0].xyz + p.x * farPoint[1].xyz + p.y * farPoint[2].xyz;
  if (isOrthographic != 0) return Ray(far + nearStep.xyz, normalize(-nearStep.xyz));
  return Ray(vec3(0.0), normalize(far));
}

// Distance along that ray to the surface of a depth value; the sky's where depth is at its far value, -1 where it is NaN.
float rayEnd(vec2 windowPosition, float depth) {
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return t <= 0.0 ? skyEnd : -1.0;
  if (isOrthographic != 0) return max(0.0, 1.0 - t) * length(nearStep.xyz);
  vec2 p = windowPosition - 0.5 * vec2(frameSize);
  vec4 far = farPoint[0] + p.x * farPoint[1] + p.y * farPoint[2];
  return length(far.xyz) / (far.w + t * nearStep.w);
}
// The phase function of all constituents together: their mean by scattering. Isotropic, Rayleigh, Henyey-Greenstein and Cornette-Shanks share one form,
//   p = norm (1 + c cos^2) (a + b (1 - cos))^(-3/2),  a = (1 - |g|)^2, b = 2 |g|   (1 + cos for g < 0),
// in which nothing cancels near the peak: 1 + g^2 - 2 g cos = (1 - |g|)^2 + 2 |g| (1 - cos) for g >= 0.

#if MONOCHROME
#define Spectrum float
#define SPECTRUM(v) (v).x
#else
#define Spectrum vec3
#define SPECTRUM(v) (v).rgb
#endif

// T(s) of DESIGN 1.
vec3 transmittanceTo(float s) { return vec3(exp(-SPECTRUM(extinction) * s)); }

// Sum over constituents of sigma_k p_k over the sum of sigma_k, 1/sr. Takes 1 - cos and 1 + cos of the scattering angle.
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

// The same of a directional light along a camera ray. theta lies between the light's travel and the direction to the eye:
// cos = -dot(l, v), |l + v|^2 / 2 = 1 - cos.
Spectrum phaseAlong(Ray ray) {
  vec3 sum = lightDirection + ray.direction, difference = lightDirection - ray.direction;
  return phaseTowardsEye(0.5 * dot(sum, sum), 0.5 * dot(difference, difference));
}
// The engine's depth buffer, of one sample.

uniform sampler2D sceneDepth;

float depthAt(ivec2 pixel) { return texelFetch(sceneDepth, pixel, 0).r; }
// In-scattered light of a lit span of a camera ray (DESIGN 1). LIGHT_KIND: 0 directional, 1 point, 2 spot.
//
// Airlight holds what a ray needs once; airlight(…, s0, s1) integrates the span [s0, s1]; litRange() says where along the
// ray the light reaches at all. The light's colour and the scattering coefficient are left out: the caller multiplies by
// lightColour, which holds both. PHASE_APART: so is a directional light's phase function, constant along the ray, too.

// (1 - exp(-x)) / x for x >= 0: a series where the difference would cancel.
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

// A length from s on over which the airlight changes by about a tenth.
float steadyLength(Airlight light, float s) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return 0.1 / max(sigma * (1.0 + abs(light.pathSlope)), 1e-30);
}

// The longest span over which a line stands for the airlight: of an optical depth of at most `most`.
float evenLength(Airlight light, float most) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return most / max(sigma * (1.0 + abs(light.pathSlope)), 1e-30);
}

// integral of exp(-sigma (e0 + (s - s0) slope)) over a span of the given length: from its dimmer exponent, so that the
// exponential never grows.
Spectrum exponentialSpan(float e0, float slope, float len) {
  Spectrum sigma = SPECTRUM(extinction);
  float start = slope < 0.0 ? e0 + slope * len : e0;
  return exp(-sigma * start) * relativeExpm1(sigma * (abs(slope) * len)) * len;
}

// Closed form (Yusov 2013, "Directional light"), with the light's own path where the medium has a boundary: in two parts
// where the ray crosses it.
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

// The longest span over which a line stands for the airlight: `most` bounds its optical depth and its length by the distance
// to the lamp at its nearest, a quarter of it where a cone's edge may lie in the span.
float evenLength(Airlight light, float most) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return min(0.5 * most / max(sigma, 1e-30), (LIGHT_KIND == 2 && outerCosine >= 0.0 ? 0.25 : 1.0) * most * sqrt(light.height2));
}

#if LIGHT_KIND == 2
// The interval of t = s - foot in which the ray is inside a cone (x: cosine >= 0, y: squared sine of its half angle):
// where b + t v >= c sqrt(t^2 + h^2). Squared, A t^2 + 2 b v t + C >= 0 with A = v^2 - c^2, C = b^2 - c^2 h^2 and
// b + t v >= 0; the convex cone meets the line in one interval, which the roots on the forward side bound. For narrow
// cones A, B and C come from the sines, in which nothing cancels: X(t) = axis x (point - light) = X0 + t X1, sin = |X| / r.
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
  // A ray through the lamp itself, as far as floats tell (the floor of airlightOf): its direction alone decides.
  if (light.height2 <= 1.01e-13 * light.foot * light.foot) return A < 0.0 ? kNone : v > 0.0 ? vec2(0.0, kFar) : vec2(-kFar, 0.0);
  float B = narrow ? -dot(light.sineFoot, light.sineSlope) : b * v;
  float discriminant = c * c * (cosSinSquared.y * light.height2 - light.axisDistance * light.axisDistance);
  if (!(discriminant > 0.0)) return kNone;
  // The stable pair of roots: q = -(B + sign(B) sqrt(D)), roots q / A and C / q.
  float q = -(B + (B < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
  float r0 = abs(A) > abs(q) * 1e-30 ? q / A : kFar * sign(q) * (A < 0.0 ? -1.0 : 1.0);
  float r1 = q != 0.0 ? C / q : 0.0;
  float low = min(r0, r1), high = max(r0, r1);
  // A >= 0: the ray's direction lies inside the double cone, each nappe is crossed once. Else both roots share a nappe.
  if (A >= 0.0) return v > 0.0 ? vec2(high, kFar) : vec2(-kFar, low);
  return b + 0.5 * (low + high) * v > 0.0 ? vec2(low, high) : kNone;
}

// Falloff of KHR_lights_punctual at t, r: ((cos - cos outer) / (cos inner - cos outer))^2 in [0, 1].
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
  // The floor guards 1/h for a ray through the light: float32 does not resolve h below 1e-7 of the light's distance.
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

// The quadrature variable is x with t = s - foot = h sinh x, r = h cosh x (equi-angular sampling is tan phi = sinh x).
// ds / r^2 = dx / r, and the integrand exp(-sigma (s + r)) p / r is analytic for |Im x| < pi/2 whatever sigma, g and h
// are, so that panels of bounded length converge alike everywhere. P = r + t and N = r - t (P N = h^2) scale as
// exp(+-x): a step along x multiplies P and divides N, h itself is not needed, and 1 - cos(theta) = P / r exactly.

// Length of [t0, t1] in x: asinh of sinh(x1 - x0), in the form that does not cancel. len = t1 - t0, known better than that.
float panelLength(float t0, float r0, float t1, float r1, float len, float height2) {
  float y = t0 * t1 > 0.0 ? len * ((t1 + t0) / (t1 * r0 + r1 * t0)) : (t1 * r0 - r1 * t0) / height2;
  y = min(y, 1e30);
  if (y < 0.3) {
    float y2 = y * y;
    return y * (1.0 + y2 * (-1.0 / 6.0 + y2 * (3.0 / 40.0 + y2 * (-15.0 / 336.0 + y2 * (105.0 / 3456.0)))));
  }
  return y > 1e6 ? log(2.0 * y) : log(y + sqrt(1.0 + y * y));
}

// The integrand at r + t = P, r - t = N; start is s + r at the span's begin and P0 its P.
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

// One smooth piece of a span: panels in x, at most 1 or 2 long and at most 6 optical depths deep, Gauss-Legendre in each.
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
  // Along a chord of the cone the falloff is a bump: two nodes resolve it only over a small part of the chord and of the
  // soft edge (len bounds the angle that a panel covers).
  float shortPanel = falloffScale == 0.0 ? 0.2 : min(falloffPanel, 0.05 * (light.lit.y - light.lit.x) / max(r0, r1));
#else
  const float longPanel = 2.0, shortPanel = 0.2;
#endif
  float start = s0 + r0;
  vec3 sigma = extinction;
  Spectrum sum = Spectrum(0.0);
  float P = P0, N = N0;
  for (int i = 0; i < kMaxPanels && remaining > 0.0; ++i) {
    // The fastest channel that is not dark yet bounds the panel.
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
  // The falloff has a kink where the ray crosses the inner cone.
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
// Inscatter of one light along a camera ray by steps, visibility looked up once per step. What is analytic stays so:
// extinction over a step, the parts of the ray outside the shadow map. Point and spot lights: steps of equal angle seen
// from the light (Kulla and Fajardo 2012), in which 1 / r^2 cancels.
//
// Needs lib/camera, lib/phase, lib/airlight. SHADOW_VIEWS: 0, 1, 2 (several). BOUNDARY: 1 if the light is dimmed on its
// way. Glass tints.
#if GLASS
#define Visibility vec3
#define Light vec3
#else
#define Visibility float
#define Light Spectrum
#endif

#if SHADOW_VIEWS > 0
// Texels of the light's shadow map and glass map, in one convention: depth grows away from the light.
// SHADOW_ARRAY, FILTER_BILINEAR, GLASS: 0 or 1.

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

// Depth stored in a texel, growing away from the light; a texel without a caster never blocks, nor does one that is not a number,
// which makes comparisons false.
float casterDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(shadowMap, texel, view).r;
  return depth < shadowViews[view].farDepth ? depth : 3e38;
}

#if GLASS
// The same of the glass: one that is not a number has nothing behind it.
float paneDepth(ivec2 texel, int view) {
  float depth = shadowViews[view].depthSign * TEXEL(glassDepth, texel, view).r;
  return depth < 3e38 ? depth : 3e38;
}
// NaN and negative values count as black, values above 1 as clear.
vec3 paneTint(ivec2 texel, int view) {
  vec3 tint = TEXEL(glassColour, texel, view).rgb;
  return mix(vec3(0.0), min(tint, vec3(1.0)), greaterThanEqual(tint, vec3(0.0)));
}
#endif

// The four texels around a cell (bilinear), clamped to the edge: low x low y, high x low y, low x high y, both high.
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

// A camera ray in a view's homogeneous texels: origin + s slope.
struct ViewLine {
  vec4 origin, slope;
};

ViewLine viewLine(int view, Ray ray) {
  return ViewLine(shadowViews[view].texelFromCamera * vec4(ray.origin, 1.0), shadowViews[view].texelFromCamera * vec4(ray.direction, 0.0));
}

// Keeps the part of [s0, s1] where c + s d >= 0.
void keepPositive(float c, float d, inout float s0, inout float s1) {
  if (d > 0.0) s0 = max(s0, -c / d);
  if (d < 0.0) s1 = min(s1, -c / d);
  if (d == 0.0 && c < 0.0) s1 = s0;
}

// Keeps the part of [s0, s1] inside a view's side planes.
void clipToSides(ViewLine line, inout float s0, inout float s1) {
  vec4 a = line.origin, b = line.slope;
  vec2 size = vec2(shadowMapSize);
  keepPositive(a.x, b.x, s0, s1);
  keepPositive(a.y, b.y, s0, s1);
  keepPositive(size.x * a.w - a.x, size.x * b.w - b.x, s0, s1);
  keepPositive(size.y * a.w - a.y, size.y * b.w - b.y, s0, s1);
}

Visibility texelVisibility(int view, vec3 p) {
  ivec2 texel = clamp(ivec2(p.xy), ivec2(0), shadowMapSize - 1);
  Visibility visibility = Visibility(p.z <= casterDepth(texel, view) ? 1.0 : 0.0);
#if GLASS
  visibility *= p.z > paneDepth(texel, view) ? paneTint(texel, view) : vec3(1.0);
#endif
  return visibility;
}

#if SHADOW_VIEWS == 1
// At a distance inside the side planes.
Visibility visibilityAt(ViewLine line, Ray ray, float s) {
  vec4 h = line.origin + s * line.slope;
  vec3 p = h.xyz / h.w;
  return p.z < shadowViews[0].nearDepth ? Visibility(1.0) : texelVisibility(0, p);
}
#else
// By the first view that holds the point; before all near planes, and outside where that is lit, there is light.
Visibility visibilityAt(ViewLine line, Ray ray, float s) {
  vec4 position = vec4(ray.origin + s * ray.direction, 1.0);
  Visibility outside = Visibility(isLitOutside != 0 ? 1.0 : 0.0);
  for (int view = 0; view < viewCount; ++view) {
    vec4 h = shadowViews[view].texelFromCamera * position;
    vec3 p = h.xyz / h.w;
    bool inSides = h.w > 0.0 && all(greaterThanEqual(p.xy, vec2(0.0))) && all(lessThan(p.xy, vec2(shadowMapSize)));
    if (!inSides || (shadowViews[view].isOpen == 0 && p.z > shadowViews[view].farDepth)) continue;
    if (p.z >= shadowViews[view].nearDepth) return texelVisibility(view, p);
    outside = Visibility(1.0);
  }
  return outside;
}
#endif

#if LIGHT_KIND == 0
// [s0, s1] in equal steps, a sample at `jitter` of each.
Light shadowedSteps(Airlight light, ViewLine line, Ray ray, float s0, float s1, int steps, float jitter) {
  float len = (s1 - s0) / float(steps);
  Light sum = Light(0.0);
#if BOUNDARY
  for (int i = 0; i < steps; ++i) {
    float s = s0 + float(i) * len;
    sum += visibilityAt(line, ray, s + jitter * len) * airlight(light, s, s + len);
  }
  return sum;
#else
  Spectrum sigma = SPECTRUM(extinction);
  Spectrum weight = exp(-sigma * s0) * relativeExpm1(sigma * len) * len, factor = exp(-sigma * len);
  float s = s0 + jitter * len;
  for (int i = 0; i < steps; ++i) {
    sum += visibilityAt(line, ray, s) * weight;
    weight *= factor;
    s += len;
  }
  return light.phase * sum;
#endif
}
#else
// With t = s - foot = h tan(phi): ds / r^2 = dphi / h, 1 - cos = 1 + sin(phi), 1 + cos = 1 - sin(phi).
Light shadowedSteps(Airlight light, ViewLine line, Ray ray, float s0, float s1, int steps, float jitter) {
  float h = sqrt(light.height2);
  float phi0 = atan((s0 - light.foot) / h), len = (atan((s1 - light.foot) / h) - phi0) / float(steps);
  Light sum = Light(0.0);
  for (int i = 0; i < steps; ++i) {
    float phi = phi0 + (float(i) + jitter) * len;
    float sine = sin(phi), r = h / max(cos(phi), 1e-6), t = r * sine, s = clamp(light.foot + t, s0, s1);
    Spectrum value = phaseTowardsEye(1.0 + sine, 1.0 - sine) * exp(-SPECTRUM(extinction) * (s + r));
#if LIGHT_KIND == 2
    value *= coneFalloff(light, t, r);
#endif
    sum += visibilityAt(line, ray, s) * value;
  }
  return sum * (len / h);
}
#endif
#endif

// Inscatter of [0, end] without the light's colour.
Light steppedLight(Ray ray, float end, int steps, float jitter) {
  Airlight light = airlightOf(ray);
  float s0 = 0.0, s1 = min(end, visibleEnd);
  litRange(light, s0, s1);
  if (!(s1 > s0)) return Light(0.0);
#if SHADOW_VIEWS == 0
  return Light(airlight(light, s0, s1));
#else
  ViewLine line = viewLine(0, ray);
  Light sum = Light(0.0);
#if SHADOW_VIEWS == 1
  float from = s0, to = s1;
  clipToSides(line, from, to);
  if (isLitOutside != 0) {
    if (!(to > from)) return Light(airlight(light, s0, s1));
    if (from > s0) sum += Light(airlight(light, s0, from));
    if (to < s1) sum += Light(airlight(light, to, s1));
  }
  s0 = from;
  s1 = to;
#endif
  if (s1 > s0) sum += shadowedSteps(light, line, ray, s0, s1, steps, jitter);
  return sum;
#endif
}

// Interleaved gradient noise in [0, 1) (Jimenez 2014).
float gradientNoise(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }
// The last pass of a technique: as the two sources of dual-source blending (COMPOSITE 1), or into two targets.

#if COMPOSITE
layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;
#else
layout(location = 0) out vec4 outInscatter;
layout(location = 1) out vec4 outTransmittance;
#endif

void writeFinal(vec3 inscatter, float end) {
  outInscatter = vec4(min(inscatter, vec3(lightCeiling)), 0.0);
  outTransmittance = vec4(exp(-extinction * end), 1.0);
}

uniform int steps;

void main() {
  float end = max(rayEnd(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))), 0.0);
  Light light = steppedLight(cameraRay(gl_FragCoord.xy), end, steps, gradientNoise(gl_FragCoord.xy));
  writeFinal(lightColour * vec3(light), end);
}
