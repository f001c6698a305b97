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
#include "lib/shadowMap.glsl"

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
  vec2 size = vec2(shadowViews[0].size);
  keepPositive(a.x, b.x, s0, s1);
  keepPositive(a.y, b.y, s0, s1);
  keepPositive(size.x * a.w - a.x, size.x * b.w - b.x, s0, s1);
  keepPositive(size.y * a.w - a.y, size.y * b.w - b.y, s0, s1);
}

Visibility texelVisibility(int view, vec3 p) {
  ivec2 texel = clamp(ivec2(p.xy), ivec2(0), shadowViews[0].size - 1);
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
    bool inSides = h.w > 0.0 && all(greaterThanEqual(p.xy, vec2(0.0))) && all(lessThan(p.xy, vec2(shadowViews[0].size)));
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
  return airlight(light, s0, s1);
#else
  ViewLine line = viewLine(0, ray);
  Light sum = Light(0.0);
#if SHADOW_VIEWS == 1
  float from = s0, to = s1;
  clipToSides(line, from, to);
  if (isLitOutside != 0) {
    if (!(to > from)) return airlight(light, s0, s1);
    if (from > s0) sum += airlight(light, s0, from);
    if (to < s1) sum += airlight(light, to, s1);
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
