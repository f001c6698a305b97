// Inscatter as epipolar textures hold it: without the light's colour where one channel is enough.
vec3 storedLight(Light light) {
#if MONOCHROME && !GLASS
  return vec3(light);
#else
  return min(lightColour.rgb * vec3(light), vec3(65504.0));
#endif
}

vec3 lightFromStored(vec3 stored) {
#if MONOCHROME && !GLASS
  return lightColour.rgb * stored.r;
#else
  return stored;
#endif
}
