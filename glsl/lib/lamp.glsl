// A point light (LIGHT_KIND 1) or a spot (2). Included by airlight.glsl.

struct Airlight {
  float foot;    // s of the point of the ray that is closest to the light
  float height2; // squared distance of the ray to the light
#if LIGHT_KIND == 2
  vec2 lit, inner; // intervals of s inside the outer and inside the inner cone
  float chord;     // length of the first
  vec3 edge;       // what the falloff is of: `along` of the cone's coordinates or, if it is wide, `axis` and 0
#endif
#if HEIGHT
  Heights heights;
#endif
};
#if HEIGHT
#include "lib/heightLamp.glsl"
#endif

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
#if HEIGHT
  float t1 = s1 - light.foot, r1 = sqrt(t1 * t1 + light.height2);
  Followed followed = followedAt(light.heights, s0, s1, s, Layers(max(r0, r1)));
  len = min(len, steadyLength(light.heights, followed, s, wayOf(light, P, s).whole, shortestWay(light, s0, s1), layersTaken(light, s)));
#endif
  return len;
}

// True if that is sure to be longer: what it takes to tell is little.
bool isSteady(Airlight light, float s, float len) {
  float t = s - light.foot, r = sqrt(t * t + light.height2), least = min(0.048 * r, 0.025 * steadyDepth());
#if LIGHT_KIND == 2
  if (falloffScale != 0.0) least = min(least, min(0.4 * falloffPanel * r, 0.01 * light.chord));
#endif
#if HEIGHT
  least = min(least, 0.05 / max(max(layersRate(light, s), layersRate(light, s + len)), 1e-30));
#endif
  return len < least;
}

// The longest span of [s0, s1] over which a line stands for the airlight: `most` bounds its optical depth and its length by the distance
// to the lamp at its nearest, a quarter of it where a cone's edge may lie in the span.
float evenLength(Airlight light, float most, float s0, float s1) {
  float sigma = max(extinction.r, max(extinction.g, extinction.b));
#if HEIGHT
  sigma += max(layersRate(light, s0), layersRate(light, s1));
#endif
  return min(0.5 * most / max(sigma, 1e-30), (LIGHT_KIND == 2 && outerCosine >= 0.0 ? 0.25 : 1.0) * most * sqrt(light.height2));
}

#if LIGHT_KIND == 2
#include "lib/cone.glsl"
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
#if HEIGHT
  light.heights = heightsAlong(ray);
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

#if HEIGHT
#include "lib/heightLampPiece.glsl"
#else
#include "lib/evenLamp.glsl"
#endif

void addAirlight(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
#if LIGHT_KIND == 2 || HEIGHT
  float from = s0;
  while (from < s1) {
    float to = s1;
#if LIGHT_KIND == 2
    // The falloff has a kink where the ray crosses the inner cone.
    if (light.inner.x < light.inner.y) {
      if (light.inner.y > from && light.inner.y < to) to = light.inner.y;
      if (light.inner.x > from && light.inner.x < to) to = light.inner.x;
    }
#endif
#if HEIGHT
    to = pieceEnd(groundCrossings(light.heights), from, to);
#endif
    addPiece(light, from, to, visibility, sum);
    from = to;
  }
#else
  addPiece(light, s0, s1, visibility, sum);
#endif
}
