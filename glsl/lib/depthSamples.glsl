// The engine's depth buffer where it may be multisampled: one of three textures. Needs lib/camera.glsl and lib/engineDepth.glsl.

uniform sampler2D sceneDepth;
uniform sampler2DMS sceneDepthSamples;
uniform sampler2DMSArray sceneDepthSampleLayers;

float sampleAt(ivec2 texel, int index) {
  return isMultisampled == 1 ? texelFetch(sceneDepthSamples, texel, index).r
                             : texelFetch(sceneDepthSampleLayers, ivec3(texel, depthLayer), index).r;
}

// Where the camera ray through a window position ends for one of the pixel's samples.
float sampleEndAt(vec2 windowPosition, int index) {
  ivec2 pixel = ivec2(windowPosition);
  float depth = isMultisampled != 0 ? plainDepth(windowPosition, sampleAt(depthTexel(pixel), index)) : texelFetch(sceneDepth, pixel, 0).r;
  return max(rayEnd(windowPosition, depth), 0.0);
}
