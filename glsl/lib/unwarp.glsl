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
