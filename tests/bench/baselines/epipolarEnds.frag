// Distances at the samples of every epipolar line. Reads the scene depth. Writes lines x samples, R32F.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depth.glsl"
#include "common/epipolar.glsl"

layout(location = 0) out float outEnd;

void main() {
  vec2 p = sampleAt(texelFetch(lines, ivec2(int(gl_FragCoord.x), 0), 0), int(gl_FragCoord.y));
  ivec2 pixel = clamp(ivec2(p), ivec2(0), frameSize - 1);
  outEnd = max(rayEnd(p, depthAt(pixel)), 0.0);
}
