// A directional light in a medium that is the same everywhere. Included by airlight.glsl.

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
float evenLength(Airlight light, float most, float s0, float s1) {
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
void addAirlight(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
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
