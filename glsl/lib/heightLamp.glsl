// What layers that thin out with height do to a lamp's light. Included by lamp.glsl.

// The light's way from the lamp to the point s, where r + t = P, and on to the eye.
Way wayOf(Airlight light, float P, float s) {
  float r = 0.5 * (P + light.height2 / P);
  Layers here = light.heights.begin + s * light.heights.slope;
  Layers eye = min(s * meanDensities(light.heights.begin, here), kEndless), whole = eye + min(r * meanDensities(exponentsAt(lightPosition), here), kEndless);
  Spectrum eyeDepth = SPECTRUM(extinction) * s + layersExtinction(eye), wholeDepth = SPECTRUM(extinction) * (light.foot + P) + layersExtinction(whole);
  return Way(min(eyeDepth, Spectrum(kEndless)), min(wholeDepth, Spectrum(kEndless)));
}

// Change of the logarithm of what layers scatter and let through a unit of length, at s, at most: the way from the lamp grows, and its mean
// density changes with the height.
float layersRate(Airlight light, float s) {
  Layers here = light.heights.begin + s * light.heights.slope, lamp = exponentsAt(lightPosition), density = densities(here), mean = meanDensities(lamp, here);
  float t = s - light.foot, r = sqrt(t * t + light.height2);
  Layers slope = abs(light.heights.slope), change = min(abs(mean - density) / max(abs(here - lamp), 1e-30), max(mean, density));
  return greatestOf(layersExtinction(density + mean + r * slope * change)) + sumOf(slope * aboveGround(here));
}
