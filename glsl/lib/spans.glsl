// The light of a span of a segment whose visibility is that of a line, with the view's share of it and what smoke and hair let through
// (DESIGN 1). Included by shadow.glsl.

// coth(x) - 1 / x: where on [-1, 1] an exponential that falls by exp(-2 x) has its mean.
float langevin(float x) {
  if (x < 0.5) return x * (1.0 / 3.0 + x * x * (-1.0 / 45.0 + x * x * (2.0 / 945.0)));
  float e = exp(-2.0 * x);
  return (1.0 + e) / (1.0 - e) - 1.0 / x;
}
vec3 langevin(vec3 x) { return vec3(langevin(x.x), langevin(x.y), langevin(x.z)); }

#if LIGHT_KIND == 0
// Light of a span where the visibility has a mean and a first moment (from -1 to 1 over the span), as that of a line. With
// fades or curves spans may be long; else the airlight falls along a line, too.
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

// The same times the view's share there.
Light sharedLight(Airlight light, ViewSegment segment, float s0, float s1, Visibility mean, Visibility moment) {
#if FADES
  // Visibility and share as lines a + b t on [-1, 1]; the mean of t squared is a third.
  float scale = (segment.share.y - segment.share.x) / max(segment.s1 - segment.s0, 1e-30);
  float middle = segment.share.x + scale * (0.5 * (s0 + s1) - segment.s0), slope = 0.5 * scale * (s1 - s0);
  Visibility inShare = mean * middle + moment * slope;
  moment = moment * middle + mean * (slope / 3.0);
  mean = inShare;
#endif
  return weightedLight(light, s0, s1, mean, moment);
}

// The line parameter at a distance along the camera ray: the inverse of distanceAt.
float parameterAt(ViewSegment segment, float s) {
  float f = (s - segment.s0) / max(segment.s1 - segment.s0, 1e-30);
  return f >= 1.0 ? 1.0 : segment.w1 * f / (segment.w0 * (1.0 - f) + segment.w1 * f);
}

#if CURVES
#include "lib/curves.glsl"
#endif

// The same from line parameter u0 to u1 of a segment, behind the smoke and hair that dim the light.
Light spanLight(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment) {
#if CURVES
  return curvedLight(light, segment, u0, u1, mean, moment);
#else
  return sharedLight(light, segment, distanceAt(segment, u0), distanceAt(segment, u1), mean, moment);
#endif
}
