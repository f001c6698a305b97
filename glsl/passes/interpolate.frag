// Interpolate: inscatter of every sample, linearly between the nearest march samples of its slice; there is no break
// between them. Reads the slice table, sampleEnds, marks, extraOffsets, marched (slices x segments) and extra (slices x samples / 4).
// Writes epipolarInscatter: slices x samples, with the sample's end coordinate (lib/stored.glsl); in parts only changedSegments.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"

#define Light vec3
#include "lib/stored.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D marks;
uniform sampler2D extraOffsets;
uniform sampler2D marched;
uniform sampler2D extra;
#if !MONOCHROME || GLASS
uniform sampler2D extraGreen;
uniform sampler2D extraBlue;
#endif
uniform sampler2D changedSegments;
flat in int isPart;
layout(location = 0) out vec4 outInscatter;

// Inscatter of a marked sample: bit `bit` of segment s of the chunk.
vec3 marchedAt(int slice, int chunk, int offset, ivec4 masks, int s, int bit) {
  int rank = extraRank(masks, 16 * s + bit);
  ivec2 at = ivec2(slice, offset + (rank >> 2));
  if (bit == 0) return texelFetch(marched, ivec2(slice, 4 * chunk + s), 0).rgb;
#if MONOCHROME && !GLASS
  return vec3(texelFetch(extra, at, 0)[rank & 3]);
#else
  return vec3(texelFetch(extra, at, 0)[rank & 3], texelFetch(extraGreen, at, 0)[rank & 3], texelFetch(extraBlue, at, 0)[rank & 3]);
#endif
}

void main() {
  int slice = int(gl_FragCoord.x), index = int(gl_FragCoord.y), samples = sliceSamples(slice);
  if (isPart != 0 && texelFetch(changedSegments, ivec2(slice, index >> 4), 0).r == 0.0) discard;
  int chunk = index >> 6, s = (index >> 4) & 3, bit = index & 15;
  ivec4 masks = masksOf(texelFetch(marks, ivec2(slice, chunk), 0));
  int offset = int(texelFetch(extraOffsets, ivec2(slice, chunk), 0).r);
  int below = masks[s] & ((2 << bit) - 1), above = masks[s] >> bit;
  int low = highestBit(max(below, 1)), high = above != 0 ? bit + lowestBit(above) : 16;
  vec3 a = marchedAt(slice, chunk, offset, masks, s, low);
  // Beyond the segment's last mark lies the next segment's first sample.
  vec3 b = high < 16 ? marchedAt(slice, chunk, offset, masks, s, high) : texelFetch(marched, ivec2(slice, (index >> 4) + 1), 0).rgb;
  vec3 inscatter = mix(a, b, high > low ? float(bit - low) / float(high - low) : 0.0);
  Ray ray = cameraRay(samplePosition(sliceEnds(slice), samples, float(index)));
  outInscatter = storedWithCoordinate(inscatter, endCoordinate(ray, texelFetch(sampleEnds, ivec2(slice, index), 0).r));
}
