// Rectangles of eight slices of which any has changed, neighbours as one. ALONG 0: in a target of slices x samples, or a part of them, over
// the segments that have; 1: in one of slices x (segments + 1); 2: over all of slices x anything; 3: over all of anything x rows. Needs
// lib/partly.glsl.

uniform sampler2D changedSlices;

const int kWidth = 8;

int lines() { return ALONG == 3 ? drawnViews * sliceCount : sliceCount; }

// Segments of a strip that have changed, from and to, and whether its rows have.
vec3 changesOf(int strip) {
  int line = min(kWidth * strip, lines() - 1);
  vec4 own = texelFetch(changedSlices, ivec2(line % sliceCount, 0), 0);
  if (ALONG == 3) // rows of two views may share a rectangle
    own = max(own, texelFetch(changedSlices, ivec2(min(line + kWidth - 1, lines() - 1) % sliceCount, 0), 0));
  return own.rgb;
}

bool isDrawn(int strip) { return ALONG == 3 ? changesOf(strip).b > 0.0 : changesOf(strip).g > 0.0; }

#include "lib/changedRuns.glsl"

// One of an instance's six vertices.
vec4 stripVertex(int vertex) {
  ivec2 run = runFrom(gl_InstanceID, (lines() + kWidth - 1) / kWidth);
  vec2 range = vec2(0.0, 1.0);
  if (ALONG < 2) {
    range = vec2(3e38, 0.0);
    for (int strip = run.x; strip < run.y; ++strip) {
      vec3 own = changesOf(strip);
      range = vec2(min(range.x, own.r), max(range.y, own.g));
    }
    range /= float(samplesPerSlice / 16 + ALONG);
  }
  bvec2 at = cornerOf(vertex);
  vec2 corner = vec2(float(kWidth * (at.x ? run.y : run.x)) / float(lines()), at.y ? range.y : range.x);
  if (ALONG == 3) corner = corner.yx;
  return run.x < run.y ? vec4(2.0 * corner - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
}
