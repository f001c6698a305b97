// Plain depth: depth out of a part of the engine's texture, of another size, a layer or in another encoding: what all other passes read in
// its place. Reads engineDepth: DEPTH_SOURCE 0 a texture, 1 an array, 2 a multisampled one, 3 an array of those. Writes plainDepth: image
// size, R32F, as lib/engineDepth.glsl says; of several samples a pixel as many texels, side by side (lib/depthSamples.glsl).
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/engineDepth.glsl"
#include "lib/depthSamples.glsl"

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

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy), shift = sampleShift(), pixel = texel >> shift, place = texel - (pixel << shift);
  int index = min(place.x + (place.y << shift.x), depthSampleCount - 1);
  outDepth = vec4(plainDepth(unjittered(vec2(pixel) + 0.5), texelAt(depthTexel(pixel), index)), 0.0, 0.0, 0.0);
}
