// What epipolar textures hold: what shadows do, not what light does. In-scattered light comes without what is constant
// (lightColour: the light's colour, the scattering coefficient) or depends on the ray's direction alone (a directional light's phase
// function; PHASE_APART in airlight.glsl), which unwarp multiplies back at each pixel: so it is not interpolated, and light of
// any unit fits. One channel is enough where extinction and phase are grey and nothing tints. A lamp's is held times the sine
// of the angle between the ray and the lamp, since near a lamp it grows as the inverse of that and would not be linear between
// samples.

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

vec3 storedLight(Light light, Ray ray) { return vec3(light) * lampSine(ray); }

// Where on its ray a sample ends, for unwarp to compare with the pixel's: the binary logarithm of the distance and, as a
// lamp's inscatter is even over the angle at the lamp, not over the distance, that angle from the ray's nearest point on.
float endCoordinate(Ray ray, float end) {
  float coordinate = log2(max(end, 1e-30));
#if LIGHT_KIND != 0
  vec3 toLight = lightPosition.xyz - ray.origin;
  coordinate += atan(end - dot(toLight, ray.direction), max(length(cross(toLight, ray.direction)), 1e-30));
#endif
  return coordinate;
}

// Epipolar inscatter carries its sample's end coordinate.
vec4 storedWithCoordinate(vec3 stored, float coordinate) {
#if MONOCHROME && !GLASS
  return vec4(stored.r, coordinate, 0.0, 0.0);
#else
  return vec4(stored, coordinate);
#endif
}

float storedCoordinate(vec4 stored) {
#if MONOCHROME && !GLASS
  return stored.g;
#else
  return stored.a;
#endif
}
