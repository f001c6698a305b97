// The light of a span of a segment whose visibility is that of a line, with the view's share of it and what smoke and hair let through
// (DESIGN 1). Included by shadow.glsl.

// coth(x) - 1 / x: where on [-1, 1] an exponential that falls by exp(-2 x) has its mean.
float langevin(float x) {
  if (x < 0.5) return x * (1.0 / 3.0 + x * x * (-1.0 / 45.0 + x * x * (2.0 / 945.0)));
  float e = exp(-2.0 * x);
  return (1.0 + e) / (1.0 - e) - 1.0 / x;
}
vec3 langevin(vec3 x) { return vec3(langevin(x.x), langevin(x.y), langevin(x.z)); }

// Adds the light of a span where the visibility has a mean and a first moment (from -1 to 1 over the span), as that of a line.
#if LIGHT_KIND == 0 && !HEIGHT
// With fades or curves spans may be long; else the airlight falls along a line, too.
void addWeighted(Airlight light, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) {
  bool attenuated = light.path + 0.5 * (s0 + s1) * light.pathSlope > 0.0;
  Spectrum fall = SPECTRUM(extinction) * ((attenuated ? 1.0 + light.pathSlope : 1.0) * (s1 - s0));
#if FADES || CURVES
  Spectrum towards = 3.0 * langevin(0.5 * abs(fall)) * sign(fall);
#else
  Spectrum towards = 0.5 * fall;
#endif
  Light own = Light(0.0);
  addAirlight(light, s0, s1, Visibility(1.0), own);
  sum += own * (mean - moment * towards);
}
#else
// As two halves, unless the visibility is even, or the airlight nearly falls along a line.
void addWeighted(Airlight light, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) {
#if HEIGHT > 1 && LIGHT_KIND == 0
  if (isShort(light, s0, s1)) {
    Light own = Light(0.0);
    Spectrum fall = addShort(light, s0, s1, Visibility(1.0), own);
    sum += own * (mean - moment * (0.5 * fall));
    return;
  }
#endif
  float end = moment == Visibility(0.0) ? s1 : 0.5 * (s0 + s1);
  Visibility own = end < s1 ? mean - 2.0 * moment : mean, behind = mean + 2.0 * moment;
  while (s0 < s1) {
    addAirlight(light, s0, end, own, sum);
    own = behind;
    s0 = end;
    end = s1;
  }
}
#endif

// The same times the view's share there.
void addShared(Airlight light, ViewSegment segment, float s0, float s1, Visibility mean, Visibility moment, inout Light sum) {
#if FADES
  // Visibility and share as lines a + b t on [-1, 1]; the mean of t squared is a third.
  float scale = (segment.share.y - segment.share.x) / max(segment.s1 - segment.s0, 1e-30);
  float middle = segment.share.x + scale * (0.5 * (s0 + s1) - segment.s0), slope = 0.5 * scale * (s1 - s0);
  Visibility inShare = mean * middle + moment * slope;
  moment = moment * middle + mean * (slope / 3.0);
  mean = inShare;
#endif
  addWeighted(light, s0, s1, mean, moment, sum);
}

// The line parameter at a distance along the camera ray: the inverse of distanceAt.
float parameterAt(ViewSegment segment, float s) {
  float f = (s - segment.s0) / max(segment.s1 - segment.s0, 1e-30);
  return f >= 1.0 ? 1.0 : f / (segment.weight * (1.0 - f) + f);
}

#if CURVES
#include "lib/curves.glsl"
#endif

// The same from line parameter u0 to u1 of a segment, behind the smoke and hair that dim the light.
void addSpan(Airlight light, ViewSegment segment, float u0, float u1, Visibility mean, Visibility moment, inout Light sum) {
#if CURVES
  addCurved(light, segment, u0, u1, mean, moment, sum);
#else
  addShared(light, segment, distanceAt(segment, u0), distanceAt(segment, u1), mean, moment, sum);
#endif
}
