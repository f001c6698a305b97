// Marks: which samples are marched; the others are interpolated between them (Yusov 2013, "Sample classification").
// Reads sampleEnds. Writes marks: slices x samples / 64, RGBA16, four masks of 16 samples (lib/bits.glsl): the first
// of each segment, both sides of every break, creases, the slice's last sample, and every second or fourth near an epipole.
#include "shared.glsl"
#include "lib/bits.glsl"
#include "lib/slices.glsl"
#include "lib/breaks.glsl"

uniform sampler2D sampleEnds;
layout(location = 0) out vec4 outMarks;

void main() {
  int slice = int(gl_FragCoord.x), first = 64 * int(gl_FragCoord.y), samples = sliceSamples(slice);
  float before = first >= 2 ? texelFetch(sampleEnds, ivec2(slice, first - 2), 0).r : -1.0;
  float low = first >= 1 ? texelFetch(sampleEnds, ivec2(slice, first - 1), 0).r : -1.0;
  float high = texelFetch(sampleEnds, ivec2(slice, first), 0).r;
  // The slice begins at an epipole in the image, or near one.
  bool dense = first == 0 && abs(epipole.z) > 0.0 && distance(sliceEnds(slice).xy * epipole.z, epipole.xy) < 32.0 * abs(epipole.z);
  ivec4 masks = ivec4(0);
  // Sample index - 1 lies between `before` and `high`: low; a break between low and high marks both.
  bool carried = false; // the sample before has a break behind it
  for (int k = 0; k <= 64; ++k) {
    int index = first + k;
    float after = index + 1 < samples ? texelFetch(sampleEnds, ivec2(slice, index + 1), 0).r : -1.0;
    bool broken = low >= 0.0 && high >= 0.0 && isBreak(before, low, high, after);
    if (k > 0 && (broken || carried || isCrease(before, low, high) || index == samples) && index <= samples) masks[(k - 1) >> 4] |= 1 << ((k - 1) & 15);
    carried = broken;
    before = low;
    low = high;
    high = after;
  }
  for (int s = 0; s < 4; ++s) {
    int from = first + 16 * s;
    if (from < samples) masks[s] |= 1;
    if (dense && s < 2) masks[s] |= s == 0 ? 0x5555 : 0x1111;
    int valid = clamp(samples - from, 0, 16);
    masks[s] &= (1 << valid) - 1;
  }
  outMarks = storedMasks(masks);
}
