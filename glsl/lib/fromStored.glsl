// Back from what epipolar textures hold (lib/stored.glsl) to in-scattered radiance. Needs lib/phase.glsl, lib/stored.glsl.

vec3 storedChannels(vec3 stored) {
#if MONOCHROME && !GLASS
  return stored.rrr;
#else
  return stored;
#endif
}

vec3 lightFromStored(vec3 stored, Ray ray) {
#if LIGHT_KIND == 0
  return lightColour.rgb * vec3(phaseAlong(ray)) * storedChannels(stored);
#else
  return lightColour.rgb * (storedChannels(stored) / lampSine(ray));
#endif
}

float brightestOf(vec3 light) { return max(light.r, max(light.g, light.b)); }
