// One depth: of a pixel's samples, for all passes that read one depth a pixel. Writes oneDepth, image size, RG32F: the mean, and 0, where
// they show one surface, else the first of them, and 1; or, R32F, the one that depthSample names.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depthSamples.glsl"

const float kOneSurface = 1.01; // of the ends of a pixel's rays: between them light hardly bends

layout(location = 0) out vec4 outDepth;

// How far a ray ends, up to a factor; a sky's is far.
float measureOf(float depth) {
  if (isOrthographic != 0) return depthShare(depth);
  float t = depthOffset + depthScale * depth;
  vec2 p = unjittered(gl_FragCoord.xy) - 0.5 * vec2(frameSize);
  return 1.0 / (farPoint[0].w + p.x * farPoint[1].w + p.y * farPoint[2].w + t * nearStep.w);
}

bool isSky(float depth) { return depthOffset + depthScale * depth <= 0.0; }

// Depth is linear over a plane, and so the mean is the depth in the samples' middle.
vec2 oneDepth() {
  float first = sampleDepthAt(0), off = 0.0, least = first, most = first;
  bool numbers = true;
  for (int k = 0; k < depthSampleCount; ++k) {
    float depth = sampleDepthAt(k);
    if (!(first == first)) first = depth;
    numbers = numbers && depth == depth;
    off += depth - first;
    least = min(least, depth);
    most = max(most, depth);
  }
  float a = measureOf(least), b = measureOf(most);
  bool one = numbers && max(a, b) <= kOneSurface * min(a, b) && isSky(least) == isSky(most);
  return one ? vec2(first + off / float(depthSampleCount), 0.0) : vec2(first, 1.0);
}

void main() { outDepth = vec4(depthSample < 0 ? oneDepth() : vec2(sampleDepthAt(depthSample), 0.0), 0.0, 0.0); }
