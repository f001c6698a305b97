// Refine: more march samples where the inscatter itself bends. Between regular march samples that a line through their
// neighbours predicts, interpolation is good enough; elsewhere every fourth sample is marched, or every second one. Not
// where breaks have filled a segment already: there it is the ends that bend the inscatter. Slices too short to tell are
// refined. With a sliceTarget bends that are less than that of the picture's mean light do not count.
// Reads marks, marched and meanLight. Writes refined marks: slices x samples / 64, RGBA16, as marks.frag does.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"
#define Light vec3
#include "lib/stored.glsl"
#include "lib/fromStored.glsl"

uniform sampler2D marks;
uniform sampler2D marched;
uniform sampler2D meanLight;
const int kCrowded = 12; // march samples in a segment
layout(location = 0) out vec4 outMarks;

// Light of a segment's regular sample, its channels as bright as they show; a single one may not show at all.
vec3 at(int slice, int segment, int last) {
  vec3 shown = lightColour / brightestOf(lightColour);
  return max(shown, vec3(1e-6)) * lightOf(texelFetch(marched, ivec2(slice, clamp(segment, 0, last)), 0).rgb);
}

// How far b lies off the line from a to c, over what is allowed: bendThreshold of the greatest of the three, or the least that counts.
float bend(vec3 a, vec3 b, vec3 c, float least) {
  return brightestOf(abs(b - 0.5 * (a + c))) / max(max(bendThreshold * brightestOf(max(max(a, b), c)), least), 1e-30);
}

// The picture's mean light, as a sample near the middle of the four segments would hold it.
float meanAt(int slice, int segment, int samples) {
  Ray ray = cameraRay(samplePosition(sliceEnds(slice), samples, float(min(16 * segment + 32, samples - 1))));
  return texelFetch(meanLight, ivec2(0), 0).r / max(brightestOf(radianceUnit(ray)), 1e-30);
}

void main() {
  int slice = int(gl_FragCoord.x), first = 4 * int(gl_FragCoord.y), samples = sliceSamples(slice), last = (samples - 1) / 16;
  ivec4 masks = masksOf(texelFetch(marks, ivec2(slice, int(gl_FragCoord.y)), 0));
  float least = sliceTarget > 0.0 ? sliceTarget * meanAt(slice, first, samples) : 0.0;
  vec3 a = at(slice, first - 1, last), b = at(slice, first, last), c = at(slice, first + 1, last);
  for (int s = 0; s < 4; ++s) {
    vec3 d = at(slice, first + s + 2, last);
    float most = max(first + s > 0 ? bend(a, b, c, least) : 0.0, first + s + 2 <= last ? bend(b, c, d, least) : 0.0);
    if (last < 2) most = 1.0 / bendThreshold;
    int valid = (1 << clamp(samples - 16 * (first + s), 0, 16)) - 1;
    if (most > 1.0 && popcount(masks[s]) < kCrowded) masks[s] |= (most > 4.0 ? 0x5555 : 0x1111) & valid;
    a = b;
    b = c;
    c = d;
  }
  outMarks = storedMasks(masks);
}
