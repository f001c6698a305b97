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

#if FOG
#define Weight vec3 // how much a span's light counts: what passes, and what is scattered besides
#else
#define Weight Visibility
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

#include "lib/exponential.glsl"
#include "lib/gauss.glsl"
#if HEIGHT
#include "lib/heightSteps.glsl"
#endif

#if LIGHT_KIND != 0
#include "lib/lamp.glsl"
#elif HEIGHT
#include "lib/heightSun.glsl"
#else
#include "lib/sun.glsl"
#endif
