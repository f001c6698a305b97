// A lamp's integral over a smooth piece of a span, in a medium that is the same everywhere. Included by lamp.glsl.

// The integrand at r + t = P, where s + r = foot + P.
Spectrum pointIntegrand(Airlight light, float P) {
  float N = light.height2 / P, r = 0.5 * (P + N);
  Spectrum value = phaseTowardsEye(P / r, N / r) * exp(-SPECTRUM(extinction) * (light.foot + P)) / r;
#if LIGHT_KIND == 2
  value *= coneFalloff(light, 0.5 * (P - N), r);
#endif
  return value;
}

// One smooth piece of a span: panels in x, at most 1 or 1.75 long and at most 6 optical depths deep, Gauss-Legendre in each.
void addPiece(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
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
