// The engine's depth buffer where it may be multisampled: one of three textures. Needs lib/camera.glsl and lib/engineDepth.glsl.

#include "lib/depth.glsl"
uniform sampler2DMS sceneDepthSamples;
uniform sampler2DMSArray sceneDepthSampleLayers;

float sampleAt(ivec2 texel, int index) {
  return isMultisampled == 1 ? texelFetch(sceneDepthSamples, texel, index).r
                             : texelFetch(sceneDepthSampleLayers, ivec3(texel, depthLayer), index).r;
}

float sampleDepthAt(int index) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  return isMultisampled != 0 ? plainDepth(unjittered(gl_FragCoord.xy), sampleAt(depthTexel(pixel), index)) : texelFetch(sceneDepth, pixel, 0).r;
}

// Where the pixel's camera ray ends for one of its samples.
float sampleEndAt(int index) {
  return max(rayEnd(unjittered(gl_FragCoord.xy), sampleDepthAt(index)), 0.0);
}
