// An image of look-ups, as a shader of surfaces makes them. Follows a method's look-up, which knows transmittanceAt(texel, depth) or, with
// OWN_FILTER 1, transmittanceIn(place, depth). Reads positions (place in the map and depth). Writes transmittance (R32F).
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1) uniform sampler2D positions;
layout(r32f, binding = 1) uniform writeonly image2D transmittance;

#if !OWN_FILTER
// Of the four texels around a place, weighted bilinearly.
float bilinearAt(vec2 place, float depth) {
  vec2 at = place * float(mapSize) - 0.5, f = fract(at);
  ivec2 low = clamp(ivec2(floor(at)), ivec2(0), ivec2(mapSize - 1)), high = clamp(ivec2(floor(at)) + 1, ivec2(0), ivec2(mapSize - 1));
  vec2 bottom = vec2(transmittanceAt(low, depth), transmittanceAt(ivec2(high.x, low.y), depth));
  vec2 top = vec2(transmittanceAt(ivec2(low.x, high.y), depth), transmittanceAt(high, depth));
  return mix(mix(bottom.x, bottom.y, f.x), mix(top.x, top.y, f.x), f.y);
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(positions, 0)))) return;
  vec3 position = texelFetch(positions, pixel, 0).xyz;
#if OWN_FILTER
  imageStore(transmittance, pixel, vec4(transmittanceIn(position.xy, position.z)));
#else
  imageStore(transmittance, pixel, vec4(bilinearAt(position.xy, position.z)));
#endif
}
