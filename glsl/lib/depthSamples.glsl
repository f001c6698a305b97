// The engine's depth buffer where it may be multisampled: one of two textures. Needs lib/camera.glsl.

uniform sampler2D sceneDepth;
uniform sampler2DMS sceneDepthSamples;

// Where the camera ray through a window position ends for one of the pixel's samples.
float sampleEndAt(vec2 windowPosition, int index) {
  ivec2 pixel = ivec2(windowPosition);
  float depth = isMultisampled != 0 ? texelFetch(sceneDepthSamples, pixel, index).r : texelFetch(sceneDepth, pixel, 0).r;
  return max(rayEnd(windowPosition, depth), 0.0);
}
