// Strips: one rectangle per 64 slices (rows), or of eight (CHANGED 1) where any has changed, neighbours as one, as long as the fullest
// of them needs, in a target of slices x fragments or, for the rows, fragments x rows.
// Reads, for the rows (STRIPS_OF_ROWS 1: four texels a fragment), the slice table, or, for the extra march samples (four
// a fragment), extraOffsets; CHANGED: changedSlices. Draws 6 vertices an instance.
#include "shared.glsl"

#ifdef STRIPS_OF_ROWS
#include "lib/slices.glsl"
#include "lib/rows.glsl"

int lines() { return march.y * grid.x; }
float fragmentsOf(int row) { return float(rowTexels(viewOfRow(row), sliceOfRow(row)) / 4); }
float room() { return float(grid.z / 4); }
#else
uniform sampler2D extraOffsets;

int lines() { return grid.x; }
float fragmentsOf(int slice) { return texelFetch(extraOffsets, ivec2(slice, grid.y / 64), 0).r; }
float room() { return float(grid.y / 4); }
#endif

#ifdef CHANGED
uniform sampler2D changedSlices;
const int kWidth = 8;

bool isDrawn(int strip) {
#ifdef STRIPS_OF_ROWS
  bool drawn = false; // rows of two views may share a strip
  for (int i = 0; i < kWidth; ++i)
    drawn = drawn || texelFetch(changedSlices, ivec2(min(kWidth * strip + i, lines() - 1) % grid.x, 0), 0).b > 0.0;
  return drawn;
#else
  return texelFetch(changedSlices, ivec2(kWidth * strip, 0), 0).g > 0.0;
#endif
}

#include "lib/changedRuns.glsl"
#else
const int kWidth = 64;

ivec2 runFrom(int strip, int strips) { return ivec2(strip, strip + 1); }
#endif

void main() {
  float fragments = 0.0;
  ivec2 run = runFrom(gl_InstanceID, (lines() + kWidth - 1) / kWidth);
  for (int line = kWidth * run.x; line < min(kWidth * run.y, lines()); ++line)
    fragments = max(fragments, fragmentsOf(line));
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(kWidth * (right ? run.y : run.x), top ? fragments : 0.0) / vec2(lines(), room());
#ifdef STRIPS_OF_ROWS
  corner = corner.yx;
#endif
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
