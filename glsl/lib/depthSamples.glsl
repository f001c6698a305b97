// The engine's depth where it may be multisampled: its own texture, or one with a pixel's samples side by side, as plainDepth.frag leaves
// them; SIDE_BY_SIDE where it is known whether it is that. Needs lib/camera.glsl.

#include "lib/depth.glsl"
uniform sampler2DMS sceneDepthSamples;

// Texels that are one pixel, where samples stand side by side.
ivec2 sampleShift() { return ivec2((depthSampleShift + 1) >> 1, depthSampleShift >> 1); }

float depthSideBySide(ivec2 pixel, int index) {
  ivec2 shift = sampleShift();
  return depthAt((pixel << shift) + ivec2(index & ((1 << shift.x) - 1), index >> shift.x));
}

float sampleDepthOf(ivec2 pixel, int index) {
#ifndef SIDE_BY_SIDE
  return isMultisampled != 0 ? texelFetch(sceneDepthSamples, pixel, index).r : depthSideBySide(pixel, index);
#elif SIDE_BY_SIDE
  return depthSideBySide(pixel, index);
#else
  return texelFetch(sceneDepthSamples, pixel, index).r;
#endif
}
float sampleDepthAt(int index) { return sampleDepthOf(ivec2(gl_FragCoord.xy), index); }

// Where a pixel's camera ray ends for one of its samples.
float sampleEndOf(ivec2 pixel, int index) {
  return max(rayEnd(unjittered(vec2(pixel) + 0.5), sampleDepthOf(pixel, index)), 0.0);
}
float sampleEndAt(int index) { return sampleEndOf(ivec2(gl_FragCoord.xy), index); }
