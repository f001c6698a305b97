// Inscatter as epipolar textures hold it: without the light's colour where one channel is enough, and times the sine of
// the angle between the ray and the lamp, since near a lamp it grows as the inverse of that and would not be linear
// between samples.

float lampSine(Ray ray) {
#if LIGHT_KIND == 0
  return 1.0;
#else
  if (epipole.w < 0.0) return 1.0; // behind the camera the inscatter stays finite
  vec3 toLight = lightPosition.xyz - ray.origin, normal = cross(toLight, ray.direction);
  float square = dot(toLight, toLight);
  return square > 0.0 ? sqrt(max(dot(normal, normal) / square, 1e-13)) : 1.0; // the floor of airlightOf
#endif
}

vec3 storedLight(Light light, Ray ray) {
#if MONOCHROME && !GLASS
  return vec3(light) * lampSine(ray);
#else
  return min(lightColour.rgb * vec3(light) * lampSine(ray), vec3(65504.0));
#endif
}

// Epipolar inscatter carries the binary logarithm of its sample's distance, for unwarp to compare with the pixel's.
vec4 storedWithEnd(vec3 stored, float end) {
  float logEnd = log2(max(end, 1e-30));
#if MONOCHROME && !GLASS
  return vec4(stored.r, logEnd, 0.0, 0.0);
#else
  return vec4(stored, logEnd);
#endif
}

float storedLogEnd(vec4 stored) {
#if MONOCHROME && !GLASS
  return stored.g;
#else
  return stored.a;
#endif
}

vec3 lightFromStored(vec3 stored, Ray ray) {
#if MONOCHROME && !GLASS
  return lightColour.rgb * (stored.r / lampSine(ray));
#else
  return stored / lampSine(ray);
#endif
}
