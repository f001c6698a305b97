// Strips: one rectangle per 64 slices (rows), or per 8 (CHANGED 1) and only where any has changed, as long as the fullest of them needs, in a target of slices x fragments or,
// for the rows, fragments x rows.
// Reads, for the rows (STRIPS_OF_ROWS 1: four texels a fragment), the slice table, or, for the extra march samples (four
// a fragment), extraOffsets; CHANGED: changedSlices. Draws 6 vertices an instance.
#include "shared.glsl"

#ifdef CHANGED
uniform sampler2D changedSlices;
const int kWidth = 8;
#ifdef STRIPS_OF_ROWS
bool isDrawn(int line) { return texelFetch(changedSlices, ivec2(line % grid.x, 0), 0).b > 0.0; }
#else
bool isDrawn(int line) { return texelFetch(changedSlices, ivec2(line, 0), 0).g > 0.0; }
#endif
#else
const int kWidth = 64;
bool isDrawn(int line) { return true; }
#endif

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

void main() {
  float fragments = 0.0;
  bool drawn = false;
  for (int i = 0; i < kWidth; ++i) {
    int line = min(kWidth * gl_InstanceID + i, lines() - 1);
    fragments = max(fragments, fragmentsOf(line));
    drawn = drawn || isDrawn(line);
  }
  bool right = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  bool top = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5;
  vec2 corner = vec2(kWidth * (gl_InstanceID + (right ? 1 : 0)), top && drawn ? fragments : 0.0) / vec2(lines(), room());
#ifdef STRIPS_OF_ROWS
  corner = corner.yx;
#endif
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
