// Sample ends: the length of the camera ray at every sample of every slice, from the nearest pixel's depth and its slope, or, keepsEnds,
// as it was. Reads the slice table, the scene depth and, keepsEnds, the last sampleEnds. Writes sampleEnds: slices x samples, R32F, world units, -1 beyond a slice's
// last sample.
// KEEPS_ENDS: 0, or 1 where the block may ask for it.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "lib/slices.glsl"

#if KEEPS_ENDS
uniform sampler2D lastSampleEnds;
#endif
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

// The pixel that shows a window position, or the nearest.
ivec2 pixelAt(vec2 p) { return clamp(ivec2(p + jitter), ivec2(0), frameSize - 1); }

// Depth at a window position: window depth is linear in the image over a plane. Without the slope a ray that runs under a
// roof would end above it.
float depthAtPosition(vec2 p) {
  ivec2 pixel = pixelAt(p);
  float depth = depthAt(pixel);
  vec2 offset = p + jitter - (vec2(pixel) + 0.5);
  float t = depthOffset + depthScale * depth;
  if (!(t > 0.0)) return depth; // the sky
  return depth + offset.x * depthSlope(pixel, depth, ivec2(1, 0)) + offset.y * depthSlope(pixel, depth, ivec2(0, 1));
}

float endOf(vec2 p, float depth) { return min(max(rayEnd(p, depth), 0.0), visibleEnd); }

// True for an end that another jitter may have seen of the surfaces that are there: between those of the nine pixels around it.
bool isBorneOut(vec2 p, float last) {
  const float kRounding = 2.5e-7; // of depths
  ivec2 middle = pixelAt(p);
  vec2 range = vec2(3e38, -3e38);
  for (int i = 0; i < 9; ++i) {
    float depth = depthAt(clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), frameSize - 1));
    if (depth < range.x) range.x = depth; // not those that are no numbers
    if (depth > range.y) range.y = depth;
  }
  float margin = kRounding * max(abs(range.x), abs(range.y)), a = endOf(p, range.x - margin), b = endOf(p, range.y + margin);
  return last >= min(a, b) && last <= max(a, b);
}

void main() {
  int slice = int(gl_FragCoord.x), index = int(gl_FragCoord.y), samples = sliceSamples(slice);
  vec2 p = samplePosition(sliceEnds(slice), samples, float(index));
  float end = endOf(p, depthAtPosition(p));
#if KEEPS_ENDS
  if (keepsEnds != 0 && index < samples) {
    float last = texelFetch(lastSampleEnds, ivec2(slice, index), 0).r;
    if (isBorneOut(p, last)) end = last;
  }
#endif
  outEnd = vec4(index < samples ? end : -1.0, 0.0, 0.0, 0.0);
}
