// Marks: which samples are marched; the others are interpolated between them (Yusov 2013, "Sample classification").
// Reads sampleEnds. Writes marks: slices x samples / 64, RGBA16, four masks of 16 samples (lib/bits.glsl): the first
// of each segment, both sides of every break, creases, the slice's last sample, and every second or fourth near an epipole. With a
// sliceTarget a directional light's breaks and creases are left out over which all light there could be differs by little of the picture's mean;
// then meanLight is read, too. EYE_CURVES: and every second or fourth where what stands before the eye is not what a line over the segment
// would have it.
#include "shared.glsl"
#include "lib/bits.glsl"
#include "lib/slices.glsl"
#include "lib/breaks.glsl"

uniform sampler2D sampleEnds;
layout(location = 0) out vec4 outMarks;

#if LIGHT_KIND == 0
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"
#include "lib/openLight.glsl"

uniform sampler2D meanLight;
// By how much the light of neighbouring samples may differ that is interpolated: so many targets, or so much of the picture's mean.
const float kTargets = 10.0, kMost = 0.1;
#endif

// What rays' light could be at most, near a sample, and by how much it may differ between two. Where that is not known all counts.
struct Open {
  bool isKnown;
  float unit; // of openTo, 1 is what it may differ by
};

Open openNear(int slice, int index) {
#if LIGHT_KIND == 0
  float mean = sliceTarget > 0.0 ? texelFetch(meanLight, ivec2(0), 0).r : 0.0;
  if (mean > 0.0 && boundary == vec4(0.0) && layerCount == 0 && isFogLit == 0) {
    Ray ray = cameraRay(samplePosition(sliceEnds(slice), sliceSamples(slice), float(index)));
    return Open(true, min(brightestOf(radianceUnit(ray)) / max(min(kTargets * sliceTarget, kMost) * mean, 1e-37), 1e37));
  }
#endif
  return Open(false, 0.0);
}

float openTo(Open open, float end) {
#if LIGHT_KIND == 0
  if (open.isKnown) return brightestOf(openLight(min(max(end, 0.0), visibleEnd)));
#endif
  return 0.0;
}

#if EYE_CURVES
#include "lib/curveNodes.glsl"
#include "lib/eyeTexels.glsl"

// Which samples of a segment show what stands before the eye where a line from its begin to its end does not tell, by a few of bendThreshold.
int seenInSegment(int slice, int from, int samples) {
  vec4 ends = sliceEnds(slice);
  int last = min(16, samples - 1 - from);
  vec2 begin = eyePassedAt(eyePlace(samplePosition(ends, samples, float(from)))), most = vec2(0.0);
  vec2 end = eyePassedAt(eyePlace(samplePosition(ends, samples, float(from + last))));
  for (int k = 2; k < last; k += 2) {
    vec2 passed = eyePassedAt(eyePlace(samplePosition(ends, samples, float(from + k))));
    most = max(most, abs(passed - mix(begin, end, float(k) / float(last))));
  }
  float off = max(most.x, most.y);
  return off > 32.0 * bendThreshold ? 0xFFFF : off > 16.0 * bendThreshold ? 0x5555 : off > 4.0 * bendThreshold ? 0x1111 : 0;
}
#endif

void main() {
  int slice = int(gl_FragCoord.x), first = 64 * int(gl_FragCoord.y), samples = sliceSamples(slice);
  float before = first >= 2 ? texelFetch(sampleEnds, ivec2(slice, first - 2), 0).r : -1.0;
  float low = first >= 1 ? texelFetch(sampleEnds, ivec2(slice, first - 1), 0).r : -1.0;
  float high = texelFetch(sampleEnds, ivec2(slice, first), 0).r;
  // The slice begins at an epipole in the image, or near one.
  bool dense = first == 0 && abs(epipole.z) > 0.0 && distance(sliceEnds(slice).xy * epipole.z, epipole.xy) < 32.0 * abs(epipole.z);
  ivec4 masks = ivec4(0);
  Open open = openNear(slice, min(first + 32, samples - 1));
  vec2 lights = vec2(openTo(open, before), openTo(open, low)); // of the two samples before
  // Sample index - 1 lies between `before` and `high`: low; a break between low and high marks both.
  bool carried = false; // the sample before has a break behind it
  for (int k = 0; k <= 64; ++k) {
    int index = first + k;
    float after = index + 1 < samples ? texelFetch(sampleEnds, ivec2(slice, index + 1), 0).r : -1.0;
    float light = openTo(open, high);
    bool broken = low >= 0.0 && high >= 0.0 && isBreak(before, low, high, after), creased = isCrease(before, low, high);
    if (open.isKnown) {
      broken = broken && open.unit * abs(light - lights.y) > 1.0;
      creased = creased && open.unit * abs(light - 2.0 * lights.y + lights.x) > 1.0;
    }
    if (k > 0 && (broken || carried || creased || index == samples) && index <= samples) masks[(k - 1) >> 4] |= 1 << ((k - 1) & 15);
    carried = broken;
    lights = vec2(lights.y, light);
    before = low;
    low = high;
    high = after;
  }
  for (int s = 0; s < 4; ++s) {
    int from = first + 16 * s;
    if (from < samples) masks[s] |= 1;
#if EYE_CURVES
    if (from < samples) masks[s] |= seenInSegment(slice, from, samples);
#endif
    if (dense && s < 2) masks[s] |= s == 0 ? 0x5555 : 0x1111;
    int valid = clamp(samples - from, 0, 16);
    masks[s] &= (1 << valid) - 1;
  }
  outMarks = storedMasks(masks);
}
