// March extra: inscatter of one light, through the shadow views of a draw, at the marked samples between the regular ones. They come
// packed, two to a fragment. If those are neighbours, the sides of a break, say, they share one ray: its light up to the nearer
// end is part of that up to the other. Reads slice table, sampleEnds, marks, extraOffsets, row textures. Writes extra: slices x
// samples / 2, both in RG32F (grey) or each in an RGBA16F of its own; added up over the draws.
#define ROW_CURVES
#define PHASE_APART
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/row.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D marks;
uniform sampler2D extraOffsets;
uniform sampler2D changedSegments;
flat in int isPart;
layout(location = 0) out vec4 outFirst;
#if !MONOCHROME || GLASS
layout(location = 1) out vec4 outSecond;
#endif

float endOf(int slice, int index) { return max(texelFetch(sampleEnds, ivec2(slice, index), 0).r, 0.0); }

bool isChanged(int slice, int index) { return isPart == 0 || texelFetch(changedSegments, ivec2(slice, index / 16), 0).r > 0.0; }

// The samples of a fragment, the same one twice if there is but one, or -1: none, or none that has changed. Of neighbours, which share
// a ray, the one that ends first comes first. Longer runs would save more, but show as steps where it is the direction that matters.
ivec2 samplesOf(int slice, int fragment) {
  int chunk = 0, offset = 0;
  for (int i = 1; i < samplesPerSlice / 64; ++i) { // the last chunk that begins here or before
    int begin = int(texelFetch(extraOffsets, ivec2(slice, i), 0).r);
    if (begin > fragment) break;
    chunk = i;
    offset = begin;
  }
  ivec4 masks = masksOf(texelFetch(marks, ivec2(slice, chunk), 0));
  int rank = 2 * (fragment - offset), low = 64 * chunk + extraSample(masks, rank);
  int high = rank + 1 < extraSamples(masks) ? 64 * chunk + extraSample(masks, rank + 1) : low;
  bool none = fragment >= int(texelFetch(extraOffsets, ivec2(slice, samplesPerSlice / 64), 0).r);
  if (none || !(isChanged(slice, low) || isChanged(slice, high))) return ivec2(-1);
  return high == low + 1 && endOf(slice, high) < endOf(slice, low) ? ivec2(high, low) : ivec2(low, high);
}

// In it and from one walk to the next few values are held: what can be had again is.
void main() {
  int slice = int(gl_FragCoord.x);
  ivec2 pair = samplesOf(slice, int(gl_FragCoord.y)); // the second with all bits turned over once it is another sample's turn
  vec3 stored = vec3(0.0), before = vec3(0.0);
  bool walking = pair.x >= 0;
  while (walking) {
    bool again = pair.y < 0;
    int own = pair.x, other = again ? ~pair.y : pair.y;
    bool share = abs(own - other) == 1;
    vec2 position = samplePosition(sliceEnds(slice), sliceSamples(slice), share ? 0.5 * float(own + other) : float(own));
    Light light = rowShadowedLight(position, share && again ? endOf(slice, other) : 0.0, endOf(slice, own), slice);
    before = stored;
    stored = storedLight(light, lampSine(cameraRay(position))) + (share && again ? stored : vec3(0.0));
    walking = !again && own != other;
    if (walking) pair = ivec2(other, ~own);
  }
  if (pair.x < 0) discard;
  bool lowIsLast = pair.y >= 0 || pair.x < ~pair.y;
  vec3 low = lowIsLast ? stored : before, high = lowIsLast ? before : stored;
#if MONOCHROME && !GLASS
  outFirst = vec4(low.r, high.r, 0.0, 0.0);
#else
  outFirst = vec4(low, 0.0);
  outSecond = vec4(high, 0.0);
#endif
}
