// In-scattered light of a lit span of a camera ray (DESIGN 1). LIGHT_KIND: 0 directional, 1 point, 2 spot.
//
// Airlight holds what a ray needs once; addAirlight() adds the integral over the span [s0, s1] to a sum, times how much of the light
// passes (one sum all the way down: sums of sums would each take registers); litRange() says where along the ray the light
// reaches at all. The light's colour and the scattering coefficient are left out: the caller multiplies by lightColour, which
// holds both. PHASE_APART: so is a directional light's phase function, constant along the ray, too.

#if GLASS
#define Visibility vec3 // fraction of the light that passes, per channel
#define Light vec3
#else
#define Visibility float
#define Light Spectrum
#endif

// A way of one optical depth in the channel that needs most care: of more where less light is left in it, after a way from where it is
// brightest or, which tells of twenty depths on, a whole way to the eye. (An error grows as the square of a step, and light of exp(-x) may
// have one exp(x) times as great; half of that, since what is brightest may lie in shadow.)
float steadyDepth(float way, float wholeWay) {
  vec3 gone = max(extinction * way, 0.5 * extinction * wholeWay - 10.0);
  vec3 depth = exp(0.25 * clamp(gone, 0.0, 240.0)) / max(extinction, vec3(1e-30));
  return min(depth.r, min(depth.g, depth.b));
}

float steadyDepth() { return 1.0 / max(max(extinction.r, max(extinction.g, extinction.b)), 1e-30); }

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

// A length from s on over which the airlight changes by about a twentieth in any channel, but more and more where it is less than where it
// is brightest: at s0 or, growing along the ray, at s1 or the medium's boundary.
float steadyLength(Airlight light, float s0, float s1, float s) {
  float path = light.path + s * light.pathSlope, whole = s + max(path, 0.0);
  bool attenuated = path > 0.0 || (path == 0.0 && light.pathSlope > 0.0);
  float slope = attenuated ? 1.0 + light.pathSlope : 1.0;
  float toBoundary = path * light.pathSlope < 0.0 ? -path / light.pathSlope : 1e30, ahead = min(toBoundary, s1 - s);
  float way = slope < 0.0 ? -slope * ahead : whole - (s0 + max(light.path + s0 * light.pathSlope, 0.0));
  float len = 0.05 * steadyDepth(way, whole) / max(abs(slope), 1e-30);
  return min(len, (slope < 0.0 ? 0.5 * ahead : toBoundary) + 0.05 * steadyDepth() / (1.0 + abs(light.pathSlope)));
}

// True if that is sure to be longer: what it takes to tell is little.
bool isSteady(Airlight light, float s, float len) { return len * (1.0 + abs(light.pathSlope)) < 0.05 * steadyDepth(); }

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
void addAirlight(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  float crossing = light.pathSlope != 0.0 ? -light.path / light.pathSlope : -1.0;
  float from = s0;
  for (int i = 0; i < 2 && from < s1; ++i) {
    float to = crossing > from && crossing < s1 ? crossing : s1;
    float path = light.path + from * light.pathSlope, middle = light.path + 0.5 * (from + to) * light.pathSlope;
    bool attenuated = middle > 0.0;
    Spectrum span = exponentialSpan(from + (attenuated ? max(path, 0.0) : 0.0), attenuated ? 1.0 + light.pathSlope : 1.0, to - from);
    sum += visibility * Light(light.phase * span);
    from = to;
  }
}

#else

struct Airlight {
  float foot;    // s of the point of the ray that is closest to the light
  float height2; // squared distance of the ray to the light
#if LIGHT_KIND == 2
  vec2 lit, inner; // intervals of s inside the outer and inside the inner cone
  float chord;     // length of the first
  vec3 edge;       // what the falloff is of: `along` of the cone's coordinates or, if it is wide, `axis` and 0
#endif
};

// A length from s on over which the airlight changes by about a twentieth in any channel, but more and more where it has become less than it
// is at s0, and but for a phase function's peak: in P = r + t (below), for what is left falls by exp(-extinction P), and directions and
// 1 / r^2 change as P does relative to itself.
float steadyLength(Airlight light, float s0, float s1, float s) {
  float t = s - light.foot, r = sqrt(t * t + light.height2), P = t > 0.0 ? r + t : light.height2 / (r - t);
  float t0 = s0 - light.foot, r0 = sqrt(t0 * t0 + light.height2);
  float next = min(1.05 * P, P + 0.05 * steadyDepth(s + r - (s0 + r0), s + r));
  float len = light.foot + 0.5 * (next - light.height2 / next) - s;
#if LIGHT_KIND == 2
  // Before, within and behind the inner cone the falloff follows the angle at the lamp, t = h tan(angle).
  if (falloffScale != 0.0) {
    bool entersInner = light.inner.x < light.inner.y;
    vec2 part = !entersInner ? light.lit : s < light.inner.x ? vec2(light.lit.x, light.inner.x) : s < light.inner.y ? light.inner : vec2(light.inner.y, light.lit.y);
    float h = sqrt(light.height2), angle = atan(part.y - light.foot, h) - atan(part.x - light.foot, h);
    len = min(len, (entersInner ? 0.02 : 0.01) * angle * (r * r / h));
  }
#endif
  return len;
}

// True if that is sure to be longer: what it takes to tell is little.
bool isSteady(Airlight light, float s, float len) {
  float t = s - light.foot, r = sqrt(t * t + light.height2), least = min(0.048 * r, 0.025 * steadyDepth());
#if LIGHT_KIND == 2
  if (falloffScale != 0.0) least = min(least, min(0.4 * falloffPanel * r, 0.01 * light.chord));
#endif
  return len < least;
}

// The longest span over which a line stands for the airlight: `most` bounds its optical depth and its length by the distance
// to the lamp at its nearest, a quarter of it where a cone's edge may lie in the span.
float evenLength(Airlight light, float most) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
  return min(0.5 * most / max(sigma, 1e-30), (LIGHT_KIND == 2 && outerCosine >= 0.0 ? 0.25 : 1.0) * most * sqrt(light.height2));
}

#if LIGHT_KIND == 2
// A ray in a cone's own coordinates, at t = s - foot: dot(axis, point - light) = axis.x + t axis.y and
// |cross(axis, point - light)|^2 = (along.x + t along.y)^2 + along.z^2, where nothing cancels.
struct ConeRay {
  vec2 axis;
  vec3 along;
  float axisDistance; // |det(light - eye, ray, axis)|
};

ConeRay coneRayOf(vec3 direction, vec3 footFromLight) {
  // Both crosses lie in the plane across the axis: in the direction of the second and across it.
  vec3 crossFoot = cross(lightDirection, footFromLight), crossSlope = cross(lightDirection, direction);
  float slope = length(crossSlope), axisDistance = dot(lightDirection, cross(crossFoot, crossSlope));
  vec3 along = vec3(length(crossFoot), 0.0, 0.0);
  if (slope > 0.0) {
    along.xy = vec2(dot(crossFoot, crossSlope) / slope, slope);
    // Next to parallel the second cross has a direction by rounding alone: whichever it is, the parts have to add up.
    along.z = slope < 1e-3 ? sqrt(max(dot(crossFoot, crossFoot) - along.x * along.x, 0.0)) : axisDistance / slope;
  }
  return ConeRay(vec2(dot(lightDirection, footFromLight), dot(lightDirection, direction)), along, axisDistance);
}

// The interval of t in which the ray is inside a cone (x: cosine >= 0, y: squared sine of its half angle):
// where b + t v >= c sqrt(t^2 + h^2). Squared, A t^2 + 2 b v t + C >= 0 with A = v^2 - c^2, C = b^2 - c^2 h^2 and
// b + t v >= 0; the convex cone meets the line in one interval, which the roots on the forward side bound. For narrow
// cones A, B and C come from the sines, in which nothing cancels; b^2 + h^2 A = h^2 sin^2 - axisDistance^2, where less cancels.
vec2 coneInterval(Airlight light, ConeRay ray, vec2 cosSinSquared) {
  const vec2 kNone = vec2(1.0, -1.0);
  const float kFar = 1e30;
  float b = ray.axis.x, v = ray.axis.y, c = cosSinSquared.x;
  if (c < 1e-4) { // a half-space: both nappes touch and the squared form has a double root; c < 0: a point light's open cone
    if (v == 0.0 || c < 0.0) return b > 0.0 || c < 0.0 ? vec2(-kFar, kFar) : kNone;
    return v > 0.0 ? vec2(-b / v, kFar) : vec2(-kFar, -b / v);
  }
  bool narrow = cosSinSquared.y < 0.5;
  float A = narrow ? cosSinSquared.y - ray.along.y * ray.along.y : v * v - c * c;
  float C = narrow ? cosSinSquared.y * light.height2 - (ray.along.x * ray.along.x + ray.along.z * ray.along.z)
                   : b * b - c * c * light.height2;
  // A ray through the lamp itself, as far as floats tell (the floors of airlightOf): its direction alone decides.
  if (light.height2 <= 1.01 * max(1e-13 * light.foot * light.foot, 1e-36)) return A < 0.0 ? kNone : v > 0.0 ? vec2(0.0, kFar) : vec2(-kFar, 0.0);
  float B = narrow ? -ray.along.x * ray.along.y : b * v;
  float discriminant = c * c * (cosSinSquared.y * light.height2 - ray.axisDistance * ray.axisDistance);
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
  vec2 edge = vec2(light.edge.x + t * light.edge.y, light.edge.z) / r;
  float difference = edge.x - outerCosine;
  if (outerSineSquared < 0.5) {
    float sineSquared = dot(edge, edge);
    difference = (outerSineSquared - sineSquared) / (sqrt(max(1.0 - sineSquared, 0.0)) + outerCosine);
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
  ConeRay cone = coneRayOf(ray.direction, ray.direction * light.foot - toLight);
  light.lit = light.foot + coneInterval(light, cone, vec2(outerCosine, outerSineSquared));
  light.inner = light.foot + coneInterval(light, cone, vec2(innerCosine, innerSineSquared));
  light.chord = light.lit.y - light.lit.x;
  light.edge = outerSineSquared < 0.5 ? cone.along : vec3(cone.axis, 0.0);
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
// exp(+-x): a step along x multiplies P, h itself is not needed, and 1 - cos(theta) = P / r exactly.

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

// The integrand at r + t = P, where s + r = foot + P.
Spectrum pointIntegrand(Airlight light, float P) {
  float N = light.height2 / P, r = 0.5 * (P + N);
  Spectrum value = phaseTowardsEye(P / r, N / r) * exp(-SPECTRUM(extinction) * (light.foot + P)) / r;
#if LIGHT_KIND == 2
  value *= coneFalloff(light, 0.5 * (P - N), r);
#endif
  return value;
}

// Gauss-Legendre nodes and weights, six and two of them.
const vec4 kNode6 = vec4(0.2386191860831969, 0.4679139345726910, 0.6612093864662645, 0.3607615730481386);
const vec2 kNode6Last = vec2(0.9324695142031521, 0.1713244923791704);
const float kNode2 = 0.5773502691896257;

// One smooth piece of a span: panels in x, at most 1 or 1.75 long and at most 6 optical depths deep, Gauss-Legendre in each.
void addPiece(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
  const int kMaxPanels = 32;
  const float kDark = 20.0; // optical depths beyond the start, or a quarter of those of the whole way, after which nothing counts
  float t0 = s0 - light.foot, t1 = s1 - light.foot;
  float r0 = sqrt(t0 * t0 + light.height2), r1 = sqrt(t1 * t1 + light.height2);
  float P0 = t0 > 0.0 ? r0 + t0 : light.height2 / (r0 - t0);
  float remaining = panelLength(t0, r0, t1, r1, s1 - s0, light.height2);
#if LIGHT_KIND == 2
  const float longPanel = 1.0; // the falloff's poles at |Im x| = pi/2 are of fourth order
  // Along a chord of the cone the falloff is a bump: two nodes resolve it only over a small part of the chord and of the
  // soft edge (len bounds the angle that a panel covers).
  float shortPanel = falloffScale == 0.0 ? 0.2 : min(falloffPanel, 0.05 * light.chord / max(r0, r1));
#else
  const float longPanel = 1.75, shortPanel = 0.2; // six nodes err by a few 1e-7
#endif
  vec3 sigma = extinction;
  float P = P0;
  for (int i = 0; i < kMaxPanels && remaining > 0.0; ++i) {
    // The fastest channel that is not dark yet bounds the panel.
    vec3 passed = sigma * max(P - P0, 0.25 * (light.foot + P));
    bvec3 dark = greaterThan(passed, vec3(kDark));
    if (all(dark)) break;
    vec3 alive = mix(sigma, vec3(0.0), dark);
    float rate = max(alive.r, max(alive.g, alive.b)) * P;
    float len = i == kMaxPanels - 1 ? remaining : min(remaining, min(longPanel, rate > 0.0 ? log(1.0 + 6.0 / rate) : longPanel));
    float halfLength = 0.5 * len;
    float middle = exp(halfLength);
    float Pm = P * middle;
    bool isShort = len < shortPanel && rate * len < 0.3;
    Spectrum panel = Spectrum(0.0); // a sum of its own, for what a sum of very many nodes would round
    for (int k = 0; k < (isShort ? 2 : 6); ++k) { // nodes in pairs around the middle
      vec2 node = isShort ? vec2(kNode2, 1.0) : k < 2 ? kNode6.xy : k < 4 ? kNode6.zw : kNode6Last;
      float step = exp((k & 1) == 0 ? -halfLength * node.x : halfLength * node.x);
      panel += node.y * pointIntegrand(light, Pm * step);
    }
    sum += (halfLength * visibility) * Light(panel);
    P = Pm * middle;
    remaining -= len;
  }
}

void addAirlight(Airlight light, float s0, float s1, Visibility visibility, inout Light sum) {
#if LIGHT_KIND == 2
  // The falloff has a kink where the ray crosses the inner cone.
  float from = s0;
  while (from < s1) {
    float to = s1;
    if (light.inner.x < light.inner.y) {
      if (light.inner.y > from && light.inner.y < to) to = light.inner.y;
      if (light.inner.x > from && light.inner.x < to) to = light.inner.x;
    }
    addPiece(light, from, to, visibility, sum);
    from = to;
  }
#else
  addPiece(light, s0, s1, visibility, sum);
#endif
}

#endif
