// A directional light's ray of which nothing is in shadow, in the unit of what textures hold (lib/fromStored.glsl): the integral of the
// transmittance, (1 - exp(-extinction * end)) / extinction, with its limit for little extinction. Not with a boundary.
vec3 openLight(float end) {
  vec3 depth = extinction * end;
  return end * mix((1.0 - exp(-depth)) / max(depth, vec3(1e-3)), 1.0 - 0.5 * depth, lessThan(depth, vec3(1e-3)));
}
