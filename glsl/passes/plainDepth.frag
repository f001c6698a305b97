// Plain depth: one depth a pixel out of a part of the engine's texture, of another size, a layer, of several samples or in another
// encoding: what all other passes read in its place. Reads engineDepth: DEPTH_SOURCE 0 a texture, 1 an array, 2 a multisampled one, 3 an
// array of those, 4 one that is all that there is to it. Writes plainDepth: image size, R32F, as lib/engineDepth.glsl says; of several
// samples RG32F: the mean, and 0, where they show one surface, else the first of them, and 1; or sampleDepth, R32F: the one that
// depthSample names; EDGES: four from that one on to firstSamples, RGBA32F, and if there are more to secondSamples.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/engineDepth.glsl"

#if DEPTH_SOURCE == 0
uniform sampler2D engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, texel, 0).r; }
#elif DEPTH_SOURCE == 1
uniform sampler2DArray engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, ivec3(texel, depthLayer), 0).r; }
#elif DEPTH_SOURCE == 2 || DEPTH_SOURCE == 4
uniform sampler2DMS engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, texel, index).r; }
#else
uniform sampler2DMSArray engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, ivec3(texel, depthLayer), index).r; }
#endif

#ifdef EDGES
layout(location = 0) out vec4 outFirst;
layout(location = 1) out vec4 outSecond;
#else
layout(location = 0) out vec4 outDepth;
#endif

#if DEPTH_SOURCE == 4
ivec2 ownTexel() { return ivec2(gl_FragCoord.xy); }
float ownDepth(float depth) { return depth; }
#else
ivec2 ownTexel() { return depthTexel(ivec2(gl_FragCoord.xy)); }
float ownDepth(float depth) { return plainDepth(unjittered(gl_FragCoord.xy), depth); }
#endif

#if DEPTH_SOURCE >= 2 && !defined(EDGES)
const float kOneSurface = 1.02; // of the ends of a pixel's rays: between them light hardly bends

bool isSky(float depth) {
#if DEPTH_SOURCE != 4
  if (depthEncoding != 0) return isEncodedSky(depth);
#endif
  return depthOffset + depthScale * depth <= 0.0;
}

// How far a ray ends, up to a factor.
float measureOf(float depth) {
  float t = depthOffset + depthScale * depth;
  vec2 p = unjittered(gl_FragCoord.xy) - 0.5 * vec2(frameSize);
#if DEPTH_SOURCE != 4
  if (depthEncoding != 0) return encodedDistance(depth);
#endif
  return isOrthographic != 0 ? 1.0 - t : 1.0 / (farPoint[0].w + p.x * farPoint[1].w + p.y * farPoint[2].w + t * nearStep.w);
}

// Window depth is linear over a plane, and so the mean is the depth in the samples' middle; of distances nearly.
vec2 oneDepth() {
  ivec2 texel = ownTexel();
  float first = texelAt(texel, 0), off = 0.0, least = first, most = first;
  bool numbers = true;
  for (int k = 0; k < depthSampleCount; ++k) {
    float depth = texelAt(texel, k);
    if (!(first == first)) first = depth;
    numbers = numbers && depth == depth;
    off += depth - first;
    least = min(least, depth);
    most = max(most, depth);
  }
  float a = measureOf(least), b = measureOf(most);
  bool one = numbers && max(a, b) <= kOneSurface * min(a, b) && isSky(least) == isSky(most);
  return one ? vec2(ownDepth(first + off / float(depthSampleCount)), 0.0) : vec2(ownDepth(first), 1.0);
}
#endif

#ifdef EDGES
float depthOf(int index) { return ownDepth(texelAt(ownTexel(), min(index, depthSampleCount - 1))); }

vec4 fourFrom(int index) { return vec4(depthOf(index), depthOf(index + 1), depthOf(index + 2), depthOf(index + 3)); }

void main() {
  outFirst = fourFrom(depthSample);
  outSecond = depthSampleCount > 4 ? fourFrom(depthSample + 4) : vec4(0.0);
}
#else
void main() {
#if DEPTH_SOURCE < 2
  outDepth = vec4(ownDepth(texelAt(ownTexel(), 0)), 0.0, 0.0, 0.0);
#else
  outDepth = vec4(depthSample < 0 ? oneDepth() : vec2(ownDepth(texelAt(ownTexel(), depthSample)), 0.0), 0.0, 0.0);
#endif
}
#endif
