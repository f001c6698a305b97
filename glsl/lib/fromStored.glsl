// Back from what epipolar textures hold (lib/stored.glsl) to in-scattered radiance. Needs lib/phase.glsl, lib/stored.glsl.

// What a texel of light stands for.
vec3 lightOf(vec3 texel) {
#if MONOCHROME && !GLASS
  return texel.rrr;
#else
  return texel / storedScale;
#endif
}

// Radiance over what a texel of light stands for, along a ray.
vec3 radianceUnit(Ray ray) {
#if LIGHT_KIND == 0
  return lightColour * vec3(phaseAlong(ray));
#else
  return lightColour / lampSine(ray);
#endif
}

float brightestOf(vec3 light) { return max(light.r, max(light.g, light.b)); }
