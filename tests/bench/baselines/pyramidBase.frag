// The pyramid's finest level: nearest and farthest depth of 2 x 2 texels of the shadow map. Writes RG32F, half its size.
#include "shared.glsl"
#include "lib/shadowMap.glsl"

layout(location = 0) out vec2 outBounds;

void main() {
  ivec2 low = 2 * ivec2(gl_FragCoord.xy), high = min(low + 1, shadowViews[0].size - 1);
  float a = casterDepth(low, 0), b = casterDepth(ivec2(high.x, low.y), 0);
  float c = casterDepth(ivec2(low.x, high.y), 0), d = casterDepth(high, 0);
  outBounds = vec2(min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}
