// Offsets: where each chunk's extra march samples begin among their slice's, packed two to a texel.
// In parts of the chunks that are drawn. Reads refined marks: slices x samples / 64. Writes extraOffsets: slices x (samples / 64 + 1), R32F, in texels; the last
// row holds the slice's sum.
#include "shared.glsl"
#include "lib/bits.glsl"
uniform sampler2D changedSlices;
flat in int isPart;

uniform sampler2D marks;
layout(location = 0) out vec4 outOffset;

void main() {
  int slice = int(gl_FragCoord.x), chunk = int(gl_FragCoord.y), sum = 0;
  int first = 0, last = samplesPerSlice / 64;
  if (isPart != 0) {
    vec2 range = texelFetch(changedSlices, ivec2(slice, 0), 0).rg; // of segments, whose marks are this frame's
    first = int(range.x) / 4;
    last = int(range.y) / 4;
  }
  for (int i = first; i < min(chunk, last); ++i)
    sum += (extraSamples(masksOf(texelFetch(marks, ivec2(slice, i), 0))) + 1) / 2;
  outOffset = vec4(float(sum), 0.0, 0.0, 0.0);
}
