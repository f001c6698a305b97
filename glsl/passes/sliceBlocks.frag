// Slice blocks: the columns of each block of eight slices (lib/slices.glsl). Reads sliceSpacing, sliceBudget. Writes (blocks + 1) x 1, RGBA32F:
// its first column, how many it has, the column that follows; behind all blocks, how many columns there are.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

uniform sampler2D sliceBudget;
layout(location = 0) out vec4 outBlock;

void main() {
  int block = int(gl_FragCoord.x), blocks = candidateSlices / SLICE_BLOCK, step = 0;
  while (step < SLICE_BUDGETS - 1 && int(texelFetch(sliceBudget, ivec2(step, 0), 0).r) > sliceCount) ++step;
  float target = budgetTarget(step);
  int first = 0, own = 0;
  for (int i = 0; i <= min(block, blocks - 1); ++i) {
    own = slicesFor(spacingOf(i), target);
    first += i < block ? own : 0;
  }
  int next = first + own;
  if (block == blocks - 1) next = slicesClosed != 0 ? 0 : next - 1;
  outBlock = vec4(float(first), float(own), float(next), 0.0);
}
