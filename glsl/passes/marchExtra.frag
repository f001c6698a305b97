// March extra: inscatter of one light, through the shadow views of a draw, at the marked samples between the regular ones. They come
// packed, four to a fragment. Two neighbours among them, the sides of a break, say, share one ray: its light up to one
// sample's end is part of that up to the next. Reads slice table, sampleEnds, marks, extraOffsets, row textures. Writes extra: slices x
// samples / 4, four samples in RGBA32F (grey) or in three RGBA16F, one a channel; added up over the draws.
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
layout(location = 1) out vec4 outGreen;
layout(location = 2) out vec4 outBlue;
#endif

const int kNone = 1 << 20; // far from every sample

// The samples in a chunk whose ranks are first, first + 1, ..., or kNone, as numbers in the chunk.
ivec4 packedSamples(ivec4 masks, int first) {
  ivec4 found = ivec4(kNone);
  int rank = 0;
  for (int s = 0; s < 4; ++s) {
    int mask = masks[s] & ~1, count = popcount(mask);
    if (rank + count <= first || rank >= first + 4) mask = 0;
    else count = 0;
    rank += count;
    while (mask != 0) {
      int bit = lowestBit(mask);
      for (int k = 0; k < 4; ++k)
        if (rank == first + k) found[k] = 16 * s + bit;
      mask &= mask - 1;
      ++rank;
    }
  }
  return found;
}

// Of two neighbours that share a ray the first and the last. Longer runs would save more, but show as steps where it is
// the direction that matters.
ivec4 runFirst(ivec4 index) {
  return ivec4(index.x, index.y == index.x + 1 ? index.x : index.y, index.z, index.w == index.z + 1 ? index.z : index.w);
}
ivec4 runLast(ivec4 index) {
  return ivec4(index.y == index.x + 1 ? index.y : index.x, index.y, index.w == index.z + 1 ? index.w : index.z, index.w);
}

void main() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice), chunk = 0, offset = 0;
  if (gl_FragCoord.y > texelFetch(extraOffsets, ivec2(slice, samplesPerSlice / 64), 0).r) discard;
  for (int i = 1; i < samplesPerSlice / 64; ++i) { // the last chunk that begins here or before
    int begin = int(texelFetch(extraOffsets, ivec2(slice, i), 0).r);
    if (begin > int(gl_FragCoord.y)) break;
    chunk = i;
    offset = begin;
  }
  vec4 line = sliceEnds(slice);
  ivec4 index = packedSamples(masksOf(texelFetch(marks, ivec2(slice, chunk), 0)), 4 * (int(gl_FragCoord.y) - offset));
  vec4 ends;
  for (int k = 0; k < 4; ++k)
    ends[k] = index[k] == kNone ? 3e38 : max(texelFetch(sampleEnds, ivec2(slice, 64 * chunk + index[k]), 0).r, 0.0);
  ivec4 first = runFirst(index), last = runLast(index);
  vec3 stored[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  bvec4 waiting = notEqual(index, ivec4(kNone));
  bool changed = isPart == 0;
  for (int k = 0; k < 4; ++k)
    changed = changed || (waiting[k] && texelFetch(changedSegments, ivec2(slice, 4 * chunk + (index[k] >> 4)), 0).r > 0.0);
  if (!changed) waiting = bvec4(false);
  Light sum = Light(0.0);
  float from = 0.0;
  int run = -1;
  while (any(waiting)) {
    // The nearest end of the first run that is not finished.
    int next = -1, nextRun = kNone, nextLast = kNone;
    float end = 3e38;
    for (int k = 0; k < 4; ++k) {
      if (!waiting[k] || (next >= 0 && (first[k] != nextRun || ends[k] >= end))) continue;
      next = k;
      nextRun = first[k];
      nextLast = last[k];
      end = ends[k];
    }
    if (nextRun != run) {
      run = nextRun;
      sum = Light(0.0);
      from = 0.0;
    }
    Ray ray = cameraRay(samplePosition(line, samples, float(64 * chunk) + 0.5 * float(nextRun + nextLast)));
    sum += rowShadowedLight(ray, from, end, slice);
    from = end;
    for (int k = 0; k < 4; ++k)
      if (k == next) stored[k] = storedLight(sum, ray);
    waiting = bvec4(waiting.x && next != 0, waiting.y && next != 1, waiting.z && next != 2, waiting.w && next != 3);
  }
  outFirst = vec4(stored[0].r, stored[1].r, stored[2].r, stored[3].r);
#if !MONOCHROME || GLASS
  outGreen = vec4(stored[0].g, stored[1].g, stored[2].g, stored[3].g);
  outBlue = vec4(stored[0].b, stored[1].b, stored[2].b, stored[3].b);
#endif
}
