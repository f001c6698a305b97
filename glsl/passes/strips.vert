// Strips: one rectangle per 64 lines, slices or rows, or, for temporal reuse, of eight where any has changed, neighbours as one, as long as
// the fullest of them needs, in a target of slices x fragments or, for the rows, fragments x rows.
// Reads, for the rows (STRIPS_OF_ROWS 1: four texels a fragment), the slice table, or, for the extra march samples (two
// a fragment), extraOffsets; changedSlices. Draws 6 vertices an instance: from 0 on all, from 6 on what has changed.
#include "shared.glsl"
#include "lib/partly.glsl"

#ifdef STRIPS_OF_ROWS
#include "lib/slices.glsl"
#include "lib/rows.glsl"

int lines() { return drawnViews * sliceCount; }
float fragmentsOf(int row) { return float(rowTexels(viewOfRow(row), sliceOfRow(row)) / 4); }
float room() { return float(rowLength / 4); }
#else
uniform sampler2D extraOffsets;

int lines() { return sliceCount; }
float fragmentsOf(int slice) { return texelFetch(extraOffsets, ivec2(slice, samplesPerSlice / 64), 0).r; }
float room() { return float(samplesPerSlice / 2); }
#endif

uniform sampler2D changedSlices;
flat out int isPart; // 1: only what has changed is drawn
const int kWidth = 8;

bool isDrawn(int strip) {
#ifdef STRIPS_OF_ROWS
  bool drawn = false; // rows of two views may share a strip
  for (int i = 0; i < kWidth; ++i)
    drawn = drawn || texelFetch(changedSlices, ivec2(min(kWidth * strip + i, lines() - 1) % sliceCount, 0), 0).b > 0.0;
  return drawn;
#else
  return texelFetch(changedSlices, ivec2(kWidth * strip, 0), 0).g > 0.0;
#endif
}

#include "lib/changedRuns.glsl"

// The lines of an instance's rectangle, from and to.
ivec2 linesOf(int strip) {
  if (isPart == 0) return ivec2(64 * strip, 64 * (strip + 1));
  return kWidth * runFrom(strip, (lines() + kWidth - 1) / kWidth);
}

void main() {
  isPart = gl_VertexID / 6;
  float fragments = 0.0;
  ivec2 run = linesOf(gl_InstanceID);
  for (int line = run.x; line < min(run.y, lines()); ++line) fragments = max(fragments, fragmentsOf(line));
  bvec2 at = cornerOf(gl_VertexID % 6);
  vec2 corner = vec2(at.x ? run.y : run.x, at.y ? fragments : 0.0) / vec2(lines(), room());
#ifdef STRIPS_OF_ROWS
  corner = corner.yx;
#endif
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
