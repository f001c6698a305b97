// Sample ends: the length of the camera ray at every sample of every slice, from the nearest pixel's depth and its slope.
// Reads the slice table and the scene depth. Writes sampleEnds: slices x samples, R32F, world units, -1 beyond a slice's
// last sample.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

layout(location = 0) out vec4 outEnd;

// The slope of the depth along an axis: the lesser change to the two neighbours, so as not to reach across an edge, where
// they agree or where the other is clearly an edge; else, among leaves, say, nothing is known and it is 0.
float depthSlope(ivec2 pixel, float depth, ivec2 axis) {
  ivec2 last = frameSize - 1;
  float ahead = depthAt(min(pixel + axis, last)) - depth, behind = depth - depthAt(max(pixel - axis, ivec2(0)));
  float lesser = abs(ahead) < abs(behind) ? ahead : behind, greater = max(abs(ahead), abs(behind));
  bool agree = ahead * behind > 0.0 && greater <= 2.0 * abs(lesser), edge = abs(lesser) <= 0.125 * greater;
  return agree || edge ? lesser : 0.0; // a neighbour that is not a number makes both false
}

// Depth at a window position: window depth is linear in the image over a plane. Without the slope a ray that runs under a
// roof would end above it.
float depthAtPosition(vec2 p) {
  ivec2 pixel = clamp(ivec2(p), ivec2(0), frameSize - 1);
  float depth = depthAt(pixel);
  vec2 offset = p - (vec2(pixel) + 0.5);
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return depth; // the sky
  return depth + offset.x * depthSlope(pixel, depth, ivec2(1, 0)) + offset.y * depthSlope(pixel, depth, ivec2(0, 1));
}

void main() {
  int slice = int(gl_FragCoord.x), index = int(gl_FragCoord.y), samples = sliceSamples(slice);
  vec2 p = samplePosition(sliceEnds(slice), samples, float(index));
  float end = min(max(rayEnd(p, depthAtPosition(p)), 0.0), visibleEnd);
  outEnd = vec4(index < samples ? end : -1.0, 0.0, 0.0, 0.0);
}
