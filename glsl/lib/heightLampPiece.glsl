// A lamp's integral over a smooth piece of a span, in a medium part of which thins out with height. Included by lamp.glsl.

// From r + t = P on by x: the change of t, in which nothing cancels where densities change over much less than P.
float stepAlong(Airlight light, float P, float x) {
  float towards = exp(-x), expm1 = x > 0.0 ? x * relativeExpm1(x) / towards : x * relativeExpm1(-x);
  return 0.5 * expm1 * (P + light.height2 / P * towards);
}

// The integrand at r + t = P, which is the point s.
Spectrum pointIntegrand(Airlight light, float P, float s) {
  float N = light.height2 / P, r = 0.5 * (P + N), t = 0.5 * (P - N);
  Phases phases = phasesTowardsEye(P / r, N / r);
  Spectrum value = phaseOf(phases, densities(light.heights.begin + s * light.heights.slope)) * exp(-wayOf(light, P, s).whole) / r;
#if LIGHT_KIND == 2
  value *= coneFalloff(light, t, r);
#endif
  return value;
}

// A length from s on over which the mean densities towards the lamp are smooth: over few e-folds, or a share of the way from where both would be
// at one height, where with a ground between the two the mean has a pole. At least a twentieth of the distance r to the lamp.
float smoothLength(Airlight light, float s, float r) {
  Layers here = light.heights.begin + s * light.heights.slope, lamp = exponentsAt(lightPosition), ground = groundExponents();
  Layers slope = abs(light.heights.slope), apart = 0.5 * abs(here - lamp);
  apart = moreThan((here - ground) * (lamp - ground), Layers(0.0), max(apart, kFolds), apart);
  Layers depth = r * mostExtinction() * densities(min(here, lamp));
  Layers len = moreThan(depth * slope, 1e-6 * slope, apart / max(slope, 1e-30), Layers(1e30));
  return max(leastOf(len), 0.05 * r);
}

// Panels in x, at most 1 or 1.75 long (evenLamp.glsl), Gauss-Legendre in each.
void addPiece(Airlight light, float s0, float s1, Weight visibility, inout Light sum) {
  float t0 = s0 - light.foot, t1 = s1 - light.foot;
  float r0 = sqrt(t0 * t0 + light.height2), r1 = sqrt(t1 * t1 + light.height2);
  float P = t0 > 0.0 ? r0 + t0 : light.height2 / (r0 - t0);
#if LIGHT_KIND == 2
  const float longPanel = 1.0;
  float shortPanel = falloffScale == 0.0 ? 0.2 : min(falloffPanel, 0.05 * light.chord / max(r0, r1));
#else
  const float longPanel = 1.75, shortPanel = 0.2;
#endif
  Followed followed = followedOf(light.heights, Layers(s0), Layers(s1), Layers(max(r0, r1)));
  Way way = wayOf(light, P, s0);
  Spectrum least = way.whole;
  float s = s0, most = longPanel; // no panel is more than four times as long as the one before: heightSun.glsl
  bool more = s1 > s0;
  for (int i = 0; i < kMostPanels && more; ++i) {
    Spectrum alive = aliveAt(way, least);
    if (greatestOf(alive) == 0.0) break;
    float N = light.height2 / P, t = 0.5 * (P - N), r = 0.5 * (P + N), smoothStep = smoothLength(light, s, r), step = min(stepFrom(followed, s), smoothStep);
    float left = abs(t) < s ? t1 - t : s1 - s; // by the smaller, which is known better: next to the lamp, or to the eye
    float toEnd = panelLength(t, r, t1, r1, max(left, 0.0), light.height2), len = min(toEnd, most), ahead = t + step;
    if (step < 1e6 * r) len = min(len, panelLength(t, r, ahead, sqrt(ahead * ahead + light.height2), step, light.height2));
    Way end = wayOf(light, P * exp(len), s + stepAlong(light, P, len));
    float change = changeOf(alive, least, way, end);
    if (change > 0.9 * kDark) {
      float to = s + stepAlong(light, P, 0.5 * len);
      Way middle = wayOf(light, P * exp(0.5 * len), to);
      if (isDarkBefore(alive, way, middle, end)) {
        s = to;
        P *= exp(0.5 * len);
        way = middle;
        continue;
      }
    }
    for (int k = 0; k < 2 && change > kDepths; ++k) { // twice, since most of a change may be at the begin
      len *= kDepths / change;
      end = wayOf(light, P * exp(len), s + stepAlong(light, P, len));
      change = changeOf(alive, least, way, end);
    }
    float halfLength = 0.5 * len, middle = exp(halfLength), Pm = P * middle, sm = s + stepAlong(light, P, halfLength);
    bool isShort = len < shortPanel && r * len < 0.2 * smoothStep && change + foldsOver(followed, s, r * len) < 0.3;
    Spectrum panel = Spectrum(0.0); // a sum of its own, for what a sum of very many nodes would round
    for (int k = 0; k < (isShort ? 2 : 6); ++k) { // nodes in pairs around the middle
      vec2 node = isShort ? vec2(kNode2, 1.0) : k < 2 ? kNode6.xy : k < 4 ? kNode6.zw : kNode6Last;
      float x = (k & 1) == 0 ? -halfLength * node.x : halfLength * node.x;
      panel += node.y * pointIntegrand(light, Pm * exp(x), sm + stepAlong(light, Pm, x));
    }
    sum += (halfLength * visibility) * Light(panel);
    more = len < toEnd;
    most = min(longPanel, 4.0 * len);
    s = sm + stepAlong(light, Pm, halfLength);
    P = Pm * middle;
    least = min(least, end.whole);
    way = end;
  }
}
