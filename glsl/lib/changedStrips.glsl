// Rectangles of eight slices of which any has changed, neighbours as one. ALONG 0: in a target of slices x samples, or a part of them, over
// the segments that have; 1: in one of slices x (segments + 1); 2: over all of slices x anything; 3: in one of anything x rows, over all or the
// parts that have. Needs lib/partly.glsl.

const int kWidth = 8;

#define PARTS rg
#include "lib/changedRuns.glsl"

int lines() { return ALONG == 3 ? drawnViews * sliceCount : sliceCount; }

// Segments of a strip that have changed, from and to.
vec2 segmentsOf(int strip) { return texelFetch(changedSlices, ivec2(min(kWidth * strip, sliceCount - 1), 0), 0).rg; }

bool isDrawn(int strip) {
  vec2 range = ALONG == 3 ? partsOfStrip(strip) : segmentsOf(strip);
  return range.y > range.x;
}

// One of an instance's six vertices.
vec4 stripVertex(int vertex) {
  ivec2 run = runFrom(gl_InstanceID, (lines() + kWidth - 1) / kWidth);
  vec2 range = vec2(0.0, 1.0);
  if (ALONG == 3) range = partsOfRun(run);
  if (ALONG < 2) {
    range = vec2(0.0);
    for (int strip = run.x; strip < run.y; ++strip) range = unionOf(range, segmentsOf(strip));
    range /= float(samplesPerSlice / 16 + ALONG);
  }
  bvec2 at = cornerOf(vertex);
  vec2 corner = vec2(float(kWidth * (at.x ? run.y : run.x)) / float(lines()), at.y ? range.y : range.x);
  if (ALONG == 3) corner = corner.yx;
  return run.x < run.y ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
