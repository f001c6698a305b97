// Plain depth: one depth a pixel out of a part of the engine's texture, of another size, a layer, of several samples or in another
// encoding: what all other passes read in its place. Reads engineDepth: DEPTH_SOURCE 0 a texture, 1 an array, 2 a multisampled one, 3 an
// array of those. Writes plainDepth: image size, R32F, as lib/engineDepth.glsl says; of several samples RG32F: their mean, and 0, where
// they show one surface, else the first of them, and 1; or sampleDepth, R32F: the one that depthSample names.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/engineDepth.glsl"

#if DEPTH_SOURCE == 0
uniform sampler2D engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, texel, 0).r; }
#elif DEPTH_SOURCE == 1
uniform sampler2DArray engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, ivec3(texel, depthLayer), 0).r; }
#elif DEPTH_SOURCE == 2
uniform sampler2DMS engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, texel, index).r; }
#else
uniform sampler2DMSArray engineDepth;
float texelAt(ivec2 texel, int index) { return texelFetch(engineDepth, ivec3(texel, depthLayer), index).r; }
#endif

layout(location = 0) out vec4 outDepth;

float depthOf(int index) { return plainDepth(unjittered(gl_FragCoord.xy), texelAt(depthTexel(ivec2(gl_FragCoord.xy)), index)); }

#if DEPTH_SOURCE >= 2
const float kOneSurface = 1.02; // of the ends of a pixel's rays: between them light hardly bends

// Window depth is linear over a plane, and so the mean is the depth in the samples' middle.
vec2 oneDepth() {
  float first = depthOf(0), chosen = first, off = 0.0, skies = 0.0, nearest = 3e38, farthest = -1.0;
  for (int k = 0; k < depthSampleCount; ++k) {
    float depth = depthOf(k), end = rayEnd(unjittered(gl_FragCoord.xy), depth); // -1 where it is NaN
    if (farthest < 0.0) chosen = depth;
    off += depth - first;
    skies += depthOffset + depthScale * depth <= 0.0 ? 1.0 : 0.0;
    nearest = min(nearest, end);
    farthest = max(farthest, end);
  }
  float count = float(depthSampleCount);
  bool one = nearest >= 0.0 && farthest <= kOneSurface * nearest && (skies == 0.0 || skies == count);
  return one ? vec2(first + off / count, 0.0) : vec2(chosen, 1.0);
}
#endif

void main() {
#if DEPTH_SOURCE < 2
  outDepth = vec4(depthOf(0), 0.0, 0.0, 0.0);
#else
  outDepth = vec4(depthSample < 0 ? oneDepth() : vec2(depthOf(depthSample), 0.0), 0.0, 0.0);
#endif
}
