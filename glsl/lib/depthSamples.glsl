// The engine's depth buffer where it may be multisampled: one of two textures. Needs lib/camera.glsl.

uniform sampler2D sceneDepth;
uniform sampler2DMS sceneDepthSamples;

// Where the pixel's camera ray ends for one of its samples.
float sampleEndAt(int index) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = isMultisampled != 0 ? texelFetch(sceneDepthSamples, pixel, index).r : texelFetch(sceneDepth, pixel, 0).r;
  return max(rayEnd(unjittered(gl_FragCoord.xy), depth), 0.0);
}
