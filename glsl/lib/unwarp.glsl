// Which pixels unwarp serves, and what they get. Needs lib/fromStored.glsl.

// Next to a lamp inscatter and its shadows change from pixel to pixel; at it every direction has a limit of its own.
bool isNearLight(vec2 p) {
  const float kNear = LIGHT_KIND == 0 ? EPIPOLE_GAP : LAMP_PIXELS;
  vec2 fromEpipole = p * epipole.z - epipole.xy;
  float near = (epipole.z > 0.0 ? kNear : EPIPOLE_GAP) * epipole.z;
  return dot(fromEpipole, fromEpipole) < near * near;
}

// Light of a pixel's ray, as textures hold it, times its weight, and that weight.
bool isServed(vec4 light) { return light.w >= leastWeight && light.w > 0.0; }

vec3 radianceOf(vec4 light, Ray ray) { return min(radianceUnit(ray) * lightOf(light.rgb / light.w), vec3(lightCeiling)); }

// How much a sample counts by where its ray ends, beside its place, at a pixel whose own ends there.
float agreementOf(float sampleEnd, float end) {
  float agreement = min(1.0, endThreshold / max(abs(sampleEnd - end), 1e-20));
  agreement *= agreement;
  return agreement * agreement;
}

// Light and weight out of sums over samples, of light and weight times that and, plain, of light and end times weight. Where the ends lead to
// the pixel's one surface runs through all of them: to leave out those that differ more, towards a horizon, say, would only pull to one side.
vec4 lightOfSums(vec4 agreeing, vec4 plain, float plainWeight, float end) {
  float apart = abs(plain.a - end * plainWeight), allowed = 0.125 * endThreshold * plainWeight;
  return mix(agreeing, vec4(plain.rgb, plainWeight), clamp(2.0 - apart / max(allowed, 1e-20), 0.0, 1.0));
}
