// Slice spacing: what is known of each block of eight slices, of which a preview has the first. From how far the preview's slices are off
// between neighbours two and four blocks apart follows how fast errors fall as slices come nearer.
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
  vec4 around = vec4(0.0), all = vec4(0.0);
  for (int i = -kAround; i <= 1 + kAround; ++i) around += texelFetch(sliceErrors, ivec2(wrapped(block + i, blocks), 0), 0);
  for (int i = 0; i < blocks; ++i) all += texelFetch(sliceErrors, ivec2(i, 0), 0);
  float error = around.x / max(around.y, 1e-30); // the square, of neighbours two blocks apart
  // By this much it falls where slices are half as far apart: at edges by 2, where light is smooth by 16. That takes many slices to tell.
  vec2 errors = min(all.xz / max(all.yw, vec2(1e-30)), vec2(1e30)); // of neighbours two blocks apart and four
  float falls = clamp(errors.y / max(errors.x, 1e-30), 2.0, 16.0);
  bool isLast = slicesClosed == 0 && block == blocks - 1; // nothing lies behind it
  outSpacing = vec4(kOfMiddle * error / falls, falls, around.y, isLast ? float(SLICE_BLOCK) : 1.0);
}
