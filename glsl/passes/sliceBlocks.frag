// Slice blocks: the columns of each block of eight slices (lib/slices.glsl). Reads sliceSpacing, sliceBudget. Writes (blocks + 1) x 1, RGBA32F:
// its first column, how many it has, the column that follows; behind all blocks, how many columns there are.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

uniform sampler2D sliceBudget;
layout(location = 0) out vec4 outBlock;

// Of the square of what the picture may be off by, this is for want of slices. The rest is for what lies between the samples of one.
const float kOfSlices = 0.7;

// The highest price that leaves no more error than is asked for or, where those take too many slices, the lowest that there is room for.
float choosePrice() {
  int step = 0;
  vec4 own = texelFetch(sliceBudget, ivec2(0), 0);
  while (step < SLICE_BUDGETS - 1) {
    vec4 next = texelFetch(sliceBudget, ivec2(step + 1, 0), 0);
    if (int(own.r) <= sliceCount && next.g > kOfSlices * sliceTarget * sliceTarget) break;
    own = next;
    ++step;
  }
  return own.b;
}

void main() {
  int block = int(gl_FragCoord.x), blocks = candidateSlices / SLICE_BLOCK;
  float price = choosePrice();
  int first = 0, own = 0;
  for (int i = 0; i <= min(block, blocks - 1); ++i) {
    own = slicesFor(spacingOf(i), price);
    first += i < block ? own : 0;
  }
  int next = first + own;
  if (block == blocks - 1) next = slicesClosed != 0 ? 0 : next - 1;
  outBlock = vec4(float(first), float(own), float(next), 0.0);
}
