// Opacity shadow map: optical depth by lines between the slices, and none in front of the first slice's interval.
layout(binding = 0) uniform sampler3D slices;

float transmittanceAt(ivec2 texel, float depth) {
  float at = clamp(depth, 0.0, 1.0) * float(SLICES) - 1.0, low = floor(at);
  float before = low < 0.0 ? 0.0 : texelFetch(slices, ivec3(texel, int(low)), 0).r;
  float behind = texelFetch(slices, ivec3(texel, min(int(low) + 1, SLICES - 1)), 0).r;
  return exp(-mix(before, behind, at - low));
}

// By the texture unit: of optical depths, whose first interval it cannot know.
float transmittanceIn(vec2 place, float depth) {
  float at = depth * float(SLICES);
  return exp(-texture(slices, vec3(place, (at - 0.5) / float(SLICES))).r * min(at, 1.0));
}
