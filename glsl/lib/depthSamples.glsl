// The engine's depth buffer where it may be multisampled: one of three textures. Needs lib/camera.glsl and lib/engineDepth.glsl.

#include "lib/depth.glsl"
uniform sampler2DMS sceneDepthSamples;
uniform sampler2DMSArray sceneDepthSampleLayers;

float sampleAt(ivec2 texel, int index) {
  return isMultisampled == 1 ? texelFetch(sceneDepthSamples, texel, index).r
                             : texelFetch(sceneDepthSampleLayers, ivec3(texel, depthLayer), index).r;
}

float sampleDepthOf(ivec2 pixel, int index) {
  return isMultisampled != 0 ? plainDepth(unjittered(vec2(pixel) + 0.5), sampleAt(depthTexel(pixel), index)) : texelFetch(sceneDepth, pixel, 0).r;
}
float sampleDepthAt(int index) { return sampleDepthOf(ivec2(gl_FragCoord.xy), index); }

// Where a pixel's camera ray ends for one of its samples.
float sampleEndOf(ivec2 pixel, int index) {
  return max(rayEnd(unjittered(vec2(pixel) + 0.5), sampleDepthOf(pixel, index)), 0.0);
}
float sampleEndAt(int index) { return sampleEndOf(ivec2(gl_FragCoord.xy), index); }
