// Offsets: where each chunk's extra march samples begin among their slice's, packed four to a texel.
// Reads refined marks: slices x samples / 64. Writes extraOffsets: slices x (samples / 64 + 1), R32F, in texels; the last
// row holds the slice's sum.
#include "shared.glsl"
#include "lib/bits.glsl"

uniform sampler2D marks;
layout(location = 0) out vec4 outOffset;

void main() {
  int slice = int(gl_FragCoord.x), chunk = int(gl_FragCoord.y), sum = 0;
  for (int i = 0; i < chunk; ++i)
    sum += (extraSamples(masksOf(texelFetch(marks, ivec2(slice, i), 0))) + 3) / 4;
  outOffset = vec4(float(sum), 0.0, 0.0, 0.0);
}
