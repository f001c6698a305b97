// Slice spacing: what is known of each block of eight slices. From how far a preview's slices, of which each block has its first, are off
// between neighbours two and four apart follows how fast errors fall as slices come nearer.
// Reads sliceErrors, of the preview. Writes blocks x 1, RGBA32F, as lib/sliceSpacing.glsl says.
#include "shared.glsl"
#include "lib/slices.glsl"

uniform sampler2D sliceErrors;
layout(location = 0) out vec4 outSpacing;

// What lies between two slices is off by less than what is in their middle: the square, by 8/15 where light is smooth and its
// interpolation off by a parabola, by 2/3 at edges of shadows.
const float kOfMiddle = 0.6;
const int kAround = 2; // blocks on either side whose slices count: one tells little

void main() {
  int block = int(gl_FragCoord.x), blocks = candidateSlices / SLICE_BLOCK;
  vec4 sum = vec4(0.0);
  for (int i = -kAround; i <= 1 + kAround; ++i) sum += texelFetch(sliceErrors, ivec2(wrapped(block + i, blocks), 0), 0);
  vec2 errors = sum.xz / max(sum.yw, vec2(1e-30)); // squares, of neighbours two blocks apart and four
  // By this much they fall where the slices are half as far apart: at edges by 2, where light is smooth by 16.
  float falls = clamp(errors.y / max(errors.x, 1e-30), 2.0, 16.0);
  bool isLast = slicesClosed == 0 && block == blocks - 1; // nothing lies behind it
  outSpacing = vec4(kOfMiddle * errors.x / falls, falls, sum.y, isLast ? float(SLICE_BLOCK) : 1.0);
}
