// Interpolate: inscatter of every sample, linearly between the nearest march samples of its slice; there is no break
// between them. Reads the slice table, marks, marched (slices x segments) and extra (slices x samples).
// Writes epipolarInscatter: slices x samples.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"

uniform sampler2D marks;
uniform sampler2D marched;
uniform sampler2D extra;
layout(location = 0) out vec4 outInscatter;

// Inscatter of a marked sample: bit `bit` of segment s of the chunk.
vec4 marchedAt(int slice, int chunk, ivec4 masks, int s, int bit) {
  int rank = 0;
  for (int i = 0; i < 3; ++i)
    rank += i < s ? popcount(masks[i] & ~1) : 0;
  rank += popcount(masks[s] & ~1 & ((1 << bit) - 1));
  return bit == 0 ? texelFetch(marched, ivec2(slice, 4 * chunk + s), 0) : texelFetch(extra, ivec2(slice, 64 * chunk + rank), 0);
}

void main() {
  int slice = int(gl_FragCoord.x), index = int(gl_FragCoord.y), samples = sliceSamples(slice);
  int chunk = index >> 6, s = (index >> 4) & 3, bit = index & 15;
  ivec4 masks = ivec4(texelFetch(marks, ivec2(slice, chunk), 0));
  int below = masks[s] & ((2 << bit) - 1), above = masks[s] >> bit;
  int low = highestBit(max(below, 1)), high = above != 0 ? bit + lowestBit(above) : 16;
  vec4 a = marchedAt(slice, chunk, masks, s, low);
  // Beyond the segment's last mark lies the next segment's first sample.
  vec4 b = high < 16 ? marchedAt(slice, chunk, masks, s, high) : texelFetch(marched, ivec2(slice, (index >> 4) + 1), 0);
  outInscatter = mix(a, b, high > low ? float(bit - low) / float(high - low) : 0.0);
}
