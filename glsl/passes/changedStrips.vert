// Changed strips: one rectangle for eight slices of which any has changed, in a target of slices x anything or
// (CHANGED_ROWS) of anything x rows. Reads changedSlices. Draws 6 vertices an instance.
#include "shared.glsl"

uniform sampler2D changedSlices;

void main() {
  const int kWidth = 8;
#ifdef CHANGED_ROWS
  int lines = march.y * grid.x;
#else
  int lines = grid.x;
#endif
  bool changed = false;
  for (int i = 0; i < kWidth; ++i)
    changed = changed || texelFetch(changedSlices, ivec2(min(kWidth * gl_InstanceID + i, lines - 1) % grid.x, 0), 0).r > 0.0;
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(float(kWidth * (gl_InstanceID + (right ? 1 : 0))) / float(lines), top ? 1.0 : 0.0);
#ifdef CHANGED_ROWS
  corner = corner.yx;
#endif
  gl_Position = changed ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
