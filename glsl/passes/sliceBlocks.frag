// Slice blocks: the columns of each block of eight slices (lib/slices.glsl). Reads sliceSpacing, sliceBudget. Writes (blocks + 1) x 1, RGBA32F:
// its first column, how many it has, the column that follows; behind all blocks, how many columns there are.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

uniform sampler2D sliceBudget;
layout(location = 0) out vec4 outBlock;

// Of the square of what the picture may be off by, this is for want of slices. The rest is for what lies between the samples of one.
const float kOfSlices = 0.7;

// The price of slices, that of more of them, and of how many more there is room.
struct Choice {
  float price, lower;
  int spare;
};

// The highest price that leaves no more error than is asked for or, if there is not room for the slices at that, the lowest at which there
// is; then what room is left goes at the price below, below the lowest also to those of which the preview saw nothing.
Choice chosenPrice() {
  int step = 0;
  float lower = -1.0;
  vec4 own = texelFetch(sliceBudget, ivec2(0), 0);
  while (step < SLICE_BUDGETS - 1) {
    vec4 next = texelFetch(sliceBudget, ivec2(step + 1, 0), 0);
    if (int(own.r) <= sliceCount && next.g > kOfSlices * sliceTarget * sliceTarget) break;
    lower = own.b;
    own = next;
    ++step;
  }
  bool isMissed = own.g > kOfSlices * sliceTarget * sliceTarget;
  return Choice(own.b, lower, isMissed ? sliceCount - int(own.r) : 0);
}

// Of a block, behind which there have to be columns for the least of those that follow, however the two shaders' numbers are rounded.
int columnsOf(int block, int blocks, int first, inout Choice choice) {
  vec4 own = spacingOf(block);
  int drawn = slicesFor(own, choice.price), more = slicesFor(own, choice.lower) - drawn;
  if (more <= choice.spare) {
    drawn += more;
    choice.spare -= more;
  }
  int behind = blocks - 1 - block, least = behind > 0 && slicesClosed == 0 ? behind - 1 + SLICE_BLOCK : behind;
  return first + drawn + least > sliceCount ? int(own.w) : drawn;
}

void main() {
  int block = int(gl_FragCoord.x), blocks = candidateSlices / SLICE_BLOCK;
  Choice choice = chosenPrice();
  int first = 0, own = 0;
  for (int i = 0; i <= min(block, blocks - 1); ++i) {
    first += own;
    own = columnsOf(i, blocks, first, choice);
  }
  int next = first + own;
  if (block == blocks) first = next;
  if (block == blocks - 1) next = slicesClosed != 0 ? 0 : next - 1;
  outBlock = vec4(float(first), float(own), float(next), 0.0);
}
