// Strips: for the extra march samples, one rectangle per 64 slices, as high as the fullest of them needs.
// Reads extraOffsets. Draws 6 vertices an instance; the target is slices x samples / 4.
#include "shared.glsl"

uniform sampler2D extraOffsets;

void main() {
  const int kWidth = 64;
  int last = grid.y / 64;
  float rows = 0.0;
  for (int i = 0; i < kWidth; ++i)
    rows = max(rows, texelFetch(extraOffsets, ivec2(min(kWidth * gl_InstanceID + i, grid.x - 1), last), 0).r);
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(kWidth * (gl_InstanceID + (right ? 1 : 0)), top ? rows : 0.0);
  gl_Position = vec4(2.0 * corner / vec2(grid.x, grid.y / 4) - 1.0, 0.0, 1.0);
}
