// Changed strips: one rectangle for eight slices of which any has changed. ALONG 0: in a target of slices x samples, or
// a part of them, over the segments that have; 1: in one of slices x (segments + 1); 2: over all of slices x anything; 3: over all of
// anything x rows. Reads changedSlices. Draws 6 vertices an instance.
#include "shared.glsl"

uniform sampler2D changedSlices;

void main() {
  const int kWidth = 8;
  int lines = ALONG == 3 ? march.y * grid.x : grid.x, line = min(kWidth * gl_InstanceID, lines - 1), segments = grid.y / 16;
  vec4 own = texelFetch(changedSlices, ivec2(line % grid.x, 0), 0);
  if (ALONG == 3) // rows of two views may share a rectangle
    own = max(own, texelFetch(changedSlices, ivec2(min(line + kWidth - 1, lines - 1) % grid.x, 0), 0));
  bool changed = ALONG == 3 ? own.b > 0.0 : own.g > 0.0;
  vec2 range = own.rg;
  range = ALONG == 0 ? range / float(segments) : ALONG == 1 ? range / float(segments + 1) : vec2(0.0, 1.0);
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(float(kWidth * (gl_InstanceID + (right ? 1 : 0))) / float(lines), top ? range.y : range.x);
  if (ALONG == 3) corner = corner.yx;
  gl_Position = changed ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
