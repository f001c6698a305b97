// How many slices of a block are drawn for a sliceTarget, from what sliceSpacing.frag has of it. Needs lib/slices.glsl.

// Expected of it with one slice: the error's square, as a part of the picture's mean; by how much that falls with twice as many; the area
// that it stands for; the least that are drawn.
uniform sampler2D sliceSpacing;

vec4 spacingOf(int block) { return texelFetch(sliceSpacing, ivec2(block, 0), 0); }

// Slices go where one more takes most of the error's square off the whole picture, down to a price: so no other choice of as many has
// less. Half of a block's slices, added to the other half, take this off for each:
float gainOf(vec4 spacing, float error, int drawn) { return min(spacing.z * error * (1.0 - 1.0 / spacing.y) / float(drawn), 1e30); }

int slicesFor(vec4 spacing, float price) {
  int drawn = int(spacing.w);
  for (float error = spacing.x; drawn < SLICE_BLOCK && gainOf(spacing, error, drawn) > price; error /= spacing.y) drawn *= 2;
  return drawn;
}

float errorWith(vec4 spacing, int drawn) {
  float error = spacing.x;
  for (int i = 1; i < drawn; i *= 2) error /= spacing.y;
  return error;
}
