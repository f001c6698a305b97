// Row nodes: min and max of sixteen texels of each row, the finest level of the tree (level 2).
// Reads the slice table and rowDepths. Writes rowNodes: texels / 16 x slices, RG; behind a row's end with bounds that add
// nothing to a coarser node's.
#include "shared.glsl"
#include "lib/slices.glsl"
uniform sampler2D rowDepths;

layout(location = 0) out vec4 outBounds;

void main() {
  if (16 * int(gl_FragCoord.x) >= rowTexels(int(gl_FragCoord.y))) {
    outBounds = rowCode.w > 0.0 ? vec4(1.0, 0.0, 0.0, 0.0) : vec4(3.4e38, -3.4e38, 0.0, 0.0);
    return;
  }
  ivec2 at = ivec2(4 * int(gl_FragCoord.x), int(gl_FragCoord.y));
  vec4 a = texelFetch(rowDepths, at, 0), b = texelFetch(rowDepths, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(rowDepths, at + ivec2(2, 0), 0), d = texelFetch(rowDepths, at + ivec2(3, 0), 0);
  vec4 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
#if FILTER_BILINEAR || GLASS
  outBounds = vec4(low.x, high.y, 0.0, 0.0);
#else
  outBounds = vec4(min(min(low.x, low.y), min(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)), 0.0, 0.0);
#endif
}
