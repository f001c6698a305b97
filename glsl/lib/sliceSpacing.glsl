// How many slices of a block are drawn for a sliceTarget, from what sliceSpacing.frag has of it. Needs lib/slices.glsl.

// Expected of it with one slice: the error's square, as a part of the picture's mean; by how much that falls with twice as many; the area
// that it stands for; the least that are drawn.
uniform sampler2D sliceSpacing;

vec4 spacingOf(int block) { return texelFetch(sliceSpacing, ivec2(block, 0), 0); }

int slicesFor(vec4 spacing, float target) {
  int drawn = int(spacing.w);
  for (float error = spacing.x; drawn < SLICE_BLOCK && error > target * target; error /= spacing.y) drawn *= 2;
  return drawn;
}

float errorWith(vec4 spacing, int drawn) {
  float error = spacing.x;
  for (int i = 1; i < drawn; i *= 2) error /= spacing.y;
  return error;
}

// Where a target would take more slices than there is room for the least of these that does not: the target times fourth roots of powers of 2. The
// last one is met by whatever is drawn, with the square a float still.
float budgetTarget(int step) { return step == SLICE_BUDGETS - 1 ? 1e18 : sliceTarget * exp2(0.25 * float(step)); }
