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
  if (epipoleSign < 0.0) return 1.0; // behind the camera the inscatter stays finite
  vec3 toLight = lightPosition - ray.origin, normal = cross(toLight, ray.direction);
  float square = dot(toLight, toLight);
  return square > 0.0 ? sqrt(max(dot(normal, normal) / square, 1e-13)) : 1.0; // the floor of airlightOf
#endif
}

// The light of a ray with that sine. Channels are held as half floats, scaled so that no light of the scene leaves their range
// (effect/src/optics/Slices.cpp).
vec3 storedLight(Light light, float sine) {
#if MONOCHROME && !GLASS
  return vec3(light) * sine;
#else
  return min(storedScale * vec3(light) * sine, vec3(65504.0));
#endif
}

// Where on its ray a sample ends, for unwarp to compare with the pixel's: the binary logarithm of the distance and, as a
// lamp's inscatter is even over the angle at the lamp, not over the distance, that angle from the ray's nearest point on.
float endCoordinate(Ray ray, float end) {
  float coordinate = log2(max(end, 1e-30));
#if LIGHT_KIND != 0
  vec3 toLight = lightPosition - ray.origin;
  coordinate += atan(end - dot(toLight, ray.direction), max(length(cross(toLight, ray.direction)), 1e-30));
#endif
  return coordinate;
}

// Epipolar inscatter carries its sample's end coordinate. Beside colours there is a half float for it, whose own steps are
// coarse and uneven: all its normal values, in their order, stand for 48 units in even steps.
const float kCoordinateSteps = 1280.0; // of a unit
const int kHalfLeast = 113 << 10, kHalfCount = 30 << 10; // bits of the normal half floats as a float has them, >> 13

float halfOfCoordinate(float coordinate) {
  int code = int(clamp((coordinate - leastCoordinate) * kCoordinateSteps + 0.5, 0.0, float(2 * kHalfCount - 1)));
  float size = intBitsToFloat((kHalfLeast + code % kHalfCount) << 13);
  return code < kHalfCount ? -size : size;
}

float coordinateOfHalf(float value) {
  int code = (floatBitsToInt(abs(value)) >> 13) - kHalfLeast + (value < 0.0 ? 0 : kHalfCount);
  return float(code) / kCoordinateSteps + leastCoordinate;
}

vec4 storedWithCoordinate(vec3 light, float coordinate) {
#if MONOCHROME && !GLASS
  return vec4(light.r, coordinate, 0.0, 0.0);
#else
  return vec4(light, halfOfCoordinate(coordinate));
#endif
}

float storedCoordinate(vec4 texel) {
#if MONOCHROME && !GLASS
  return texel.g;
#else
  return coordinateOfHalf(texel.a);
#endif
}
