// The light of a span where the visibility is that of a line (DESIGN 1). Needs lib/airlight.glsl.

// A mean over a span and a first moment, from -1 to 1 over it.
struct VisibilityLine {
  Visibility mean, moment;
};

// Of the line over [s0, s1] the part over [sa, sb].
VisibilityLine partOf(VisibilityLine line, float s0, float s1, float sa, float sb) {
  float inverse = 1.0 / max(s1 - s0, 1e-30);
  return VisibilityLine(line.mean + 3.0 * line.moment * ((sa + sb - s0 - s1) * inverse), line.moment * ((sb - sa) * inverse));
}

// Times a transmittance's line over the same span: a mean of t squared is a third.
VisibilityLine dimmedBy(VisibilityLine line, vec2 passed) {
  return VisibilityLine(line.mean * passed.x + 3.0 * line.moment * passed.y, line.mean * passed.y + line.moment * passed.x);
}

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
void addWeighted(Airlight light, float s0, float s1, Weight mean, Weight moment, inout Light sum) {
  bool attenuated = light.path + 0.5 * (s0 + s1) * light.pathSlope > 0.0;
  Spectrum fall = SPECTRUM(extinction) * ((attenuated ? 1.0 + light.pathSlope : 1.0) * (s1 - s0));
#if SHADOW_VIEWS == 2 || CURVES || EYE_CURVES
  Spectrum towards = 3.0 * langevin(0.5 * abs(fall)) * sign(fall);
#else
  Spectrum towards = 0.5 * fall;
#endif
  Light own = Light(0.0);
  addAirlight(light, s0, s1, Weight(1.0), own);
  sum += own * (mean - moment * towards);
}
#else
// As two halves, unless the visibility is even, or the airlight nearly falls along a line.
void addWeighted(Airlight light, float s0, float s1, Weight mean, Weight moment, inout Light sum) {
#if HEIGHT > 1 && LIGHT_KIND == 0
  if (isShort(light, s0, s1)) {
    Light own = Light(0.0);
    Spectrum fall = addShort(light, s0, s1, Weight(1.0), own);
    sum += own * (mean - moment * (0.5 * fall));
    return;
  }
#endif
  float end = moment == Weight(0.0) ? s1 : 0.5 * (s0 + s1);
  Weight own = end < s1 ? mean - 2.0 * moment : mean, behind = mean + 2.0 * moment;
  while (s0 < s1) {
    addAirlight(light, s0, end, own, sum);
    own = behind;
    s0 = end;
    end = s1;
  }
}
#endif
