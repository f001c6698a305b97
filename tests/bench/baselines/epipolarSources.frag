// Which two samples of its line a sample is interpolated between (Engelhardt and Dachsbacher 2010, 4.2): every
// `spacing`-th, and both sides of each depth discontinuity. A sample that is its own source is marched.
// Reads sampleEnds. Writes the two indices, lines x samples, RG32F.
#include "shared.glsl"
#include "common/agreement.glsl"
#include "common/epipolar.glsl"

uniform sampler2D sampleEnds;
uniform int spacing;
layout(location = 0) out vec2 outSources;

bool isBreak(float a, float b) { return abs(a - b) > 0.1 * max(a, b); }

void main() {
  int line = int(gl_FragCoord.x), index = int(gl_FragCoord.y);
  int first = index / spacing * spacing, last = min(first + spacing, int(gridSize.y) - 1);
  float end = comparableEnd(texelFetch(sampleEnds, ivec2(line, index), 0).r);
  int low = index, high = index;
  float before = end;
  for (bool walking = low > first; walking;) {
    float next = comparableEnd(texelFetch(sampleEnds, ivec2(line, low - 1), 0).r);
    walking = !isBreak(before, next);
    if (walking) --low;
    before = next;
    walking = walking && low > first;
  }
  before = end;
  for (bool walking = high < last && index > first; walking;) {
    float next = comparableEnd(texelFetch(sampleEnds, ivec2(line, high + 1), 0).r);
    walking = !isBreak(before, next);
    if (walking) ++high;
    before = next;
    walking = walking && high < last;
  }
  if (index == first) low = high = index;
  outSources = vec2(low, high);
}
