// How many slices of a block are drawn at a price of slices, from what sliceSpacing.frag has of it. Needs lib/slices.glsl.

// Expected of it with one slice: the error's square, as a part of the picture's mean; by how much that falls with twice as many; how much it
// counts, by the area that the slices around stand for; the least that are drawn.
uniform sampler2D sliceSpacing;

vec4 spacingOf(int block) { return texelFetch(sliceSpacing, ivec2(block, 0), 0); }

// What each of as many slices again as there are takes off the square of the whole picture's error. Where slices are drawn down to a price of
// that, no other choice of as many is expected to leave less.
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
