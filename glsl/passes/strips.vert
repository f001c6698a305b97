// Strips: one rectangle per 64 lines, slices or rows, or, for temporal reuse, of eight where any has changed, neighbours as one, as long as
// the fullest of them needs, of rows no more than what objects can have moved, in a target of slices x fragments or, for the rows, fragments x rows.
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

flat out int isPart; // 1: only what has changed is drawn
const int kWidth = 8;

#define PARTS ba
#include "lib/changedRuns.glsl"

bool isDrawn(int strip) {
#ifdef STRIPS_OF_ROWS
  vec2 range = partsOfStrip(strip);
#else
  vec2 range = texelFetch(changedSlices, ivec2(kWidth * strip, 0), 0).rg;
#endif
  return range.y > range.x;
}

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
  vec2 range = vec2(0.0, fragments / room());
#ifdef STRIPS_OF_ROWS
  if (isPart != 0) range = min(partsOfRun(run / kWidth), range.yy);
#endif
  vec2 corner = vec2(float(at.x ? run.y : run.x) / float(lines()), at.y ? range.y : range.x);
#ifdef STRIPS_OF_ROWS
  corner = corner.yx;
#endif
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
