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

// The brightest channel of stored light.
float brightestOf(vec4 stored) {
#if MONOCHROME && !GLASS
  return stored.r;
#else
  return max(stored.r, max(stored.g, stored.b));
#endif
}

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

// Epipolar inscatter carries its sample's end coordinate. Beside colours there is a half float for it, whose own steps are
// coarse and uneven: all its normal values, in their order, stand for -20 to 28 in even steps.
const float kCoordinateLeast = -20.0, kCoordinateSteps = 1280.0; // steps of a unit
const int kHalfLeast = 113 << 10, kHalfCount = 30 << 10; // bits of the normal half floats as a float has them, >> 13

float halfOfCoordinate(float coordinate) {
  int code = clamp(int((coordinate - kCoordinateLeast) * kCoordinateSteps + 0.5), 0, 2 * kHalfCount - 1);
  float size = intBitsToFloat((kHalfLeast + code % kHalfCount) << 13);
  return code < kHalfCount ? -size : size;
}

float coordinateOfHalf(float value) {
  int code = (floatBitsToInt(abs(value)) >> 13) - kHalfLeast + (value < 0.0 ? 0 : kHalfCount);
  return float(code) / kCoordinateSteps + kCoordinateLeast;
}

vec4 storedWithCoordinate(vec3 stored, float coordinate) {
#if MONOCHROME && !GLASS
  return vec4(stored.r, coordinate, 0.0, 0.0);
#else
  return vec4(stored, halfOfCoordinate(coordinate));
#endif
}

float storedCoordinate(vec4 stored) {
#if MONOCHROME && !GLASS
  return stored.g;
#else
  return coordinateOfHalf(stored.a);
#endif
}

vec3 lightFromStored(vec3 stored, Ray ray) {
#if MONOCHROME && !GLASS
  return lightColour.rgb * (stored.r / lampSine(ray));
#else
  return stored / lampSine(ray);
#endif
}
