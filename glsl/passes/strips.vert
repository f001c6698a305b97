// Strips: for the extra march samples, one rectangle per eight slices and chunk of 64 samples, as high as the fullest of
// the eight needs. Reads marks. Draws 6 vertices an instance; the target is slices x samples.
#include "shared.glsl"
#include "lib/bits.glsl"

uniform sampler2D marks;

int extraSamples(vec4 masks) {
  int sum = 0;
  for (int s = 0; s < 4; ++s)
    sum += max(popcount(int(masks[s])) - 1, 0);
  return sum;
}

void main() {
  int strips = (grid.x + 7) / 8, strip = gl_InstanceID % strips, chunk = gl_InstanceID / strips;
  int rows = 0;
  for (int i = 0; i < 8; ++i)
    rows = max(rows, extraSamples(texelFetch(marks, ivec2(min(8 * strip + i, grid.x - 1), chunk), 0)));
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(8 * (strip + (right ? 1 : 0)), 64 * chunk + (top ? rows : 0));
  gl_Position = vec4(2.0 * corner / vec2(grid.xy) - 1.0, 0.0, 1.0);
}
