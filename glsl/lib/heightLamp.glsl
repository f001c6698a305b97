// What layers that thin out with height do to a lamp's light. Included by lamp.glsl.

// The light's way from the lamp to the point s, where r + t = P, and on to the eye.
Way wayOf(Airlight light, float P, float s) {
  float r = 0.5 * (P + light.height2 / P);
  Layers here = light.heights.begin + s * light.heights.slope;
  Layers eye = min(s * meanDensities(light.heights.begin, here), kEndless), whole = eye + min(r * meanDensities(exponentsAt(lightPosition), here), kEndless);
  Spectrum eyeDepth = SPECTRUM(extinction) * s + layersExtinction(eye), wholeDepth = SPECTRUM(extinction) * (light.foot + P) + layersExtinction(whole);
  return Way(min(eyeDepth, Spectrum(kEndless)), min(wholeDepth, Spectrum(kEndless)));
}

// Optical depth of the light's way by a point of [s0, s1], about where that is least: at an end, or next to the lamp.
Spectrum shortestWay(Airlight light, float s0, float s1) {
  Spectrum least = Spectrum(kEndless);
  for (int i = 0; i < 3; ++i) {
    float s = i == 0 ? s0 : i == 1 ? s1 : clamp(light.foot, s0, s1), t = s - light.foot, r = sqrt(t * t + light.height2);
    least = min(least, wayOf(light, t > 0.0 ? r + t : light.height2 / (r - t), s).whole);
  }
  return least;
}

// What layers take of the light a unit of length, at s, at most, in each channel: the way from the lamp grows, and its mean density changes
// with the height.
Spectrum layersTaken(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope, lamp = exponentsAt(lightPosition), density = densities(here), mean = meanDensities(lamp, here);
  float t = s - light.foot, r = sqrt(t * t + light.height2);
  Layers slope = abs(light.heights.slope), change = min(abs(mean - density) / max(abs(here - lamp), 1e-30), max(mean, density));
  return layersExtinction(density + mean + r * slope * change);
}

// Change of the logarithm of what they scatter and let through a unit of length, at s, at most.
float layersRate(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope;
  return greatestOf(layersTaken(light, s)) + sumOf(abs(light.heights.slope) * aboveGround(here));
}
