// What layers that thin out with height do to a lamp's light. Included by lamp.glsl.

// The light's way from the lamp to the point s, where r + t = P, and on to the eye.
Way wayOf(Airlight light, float P, float s) {
  float r = 0.5 * (P + light.height2 / P);
  Layers here = light.heights.begin + s * light.heights.slope;
  Layers eye = s * meanDensities(light.heights.begin, here), whole = eye + r * meanDensities(exponentsAt(lightPosition), here);
  return Way(SPECTRUM(extinction) * s + layersExtinction(eye), SPECTRUM(extinction) * (light.foot + P) + layersExtinction(whole));
}

// Change of the logarithm of what layers scatter and let through a unit of length, at s, at most.
float layersRate(Airlight light, float s) {
  Layers exponents = light.heights.begin + s * light.heights.slope;
  return 2.0 * greatestOf(layersExtinction(densities(exponents))) + sumOf(abs(light.heights.slope) * aboveGround(exponents));
}
