// Curve tree: over the cells of each row nodes of 4, 16, ... cells behind one another, up to one for all (lib/curves.glsl). Reads
// curveCells. Writes curveTree: nodes x rows, RGBA32F: least first depth, greatest last depth, mean and first moment (from -1 to 1) of the
// transmittance behind it.
#include "shared.glsl"

uniform sampler2D curveCells;
layout(location = 0) out vec4 outNode;

void main() {
  int node = int(gl_FragCoord.x), row = int(gl_FragCoord.y), level = 1, cells = curvesSize;
  while (node >= (cells + (1 << (2 * level)) - 1) >> (2 * level) && level < 8) {
    node -= (cells + (1 << (2 * level)) - 1) >> (2 * level);
    ++level;
  }
  int first = node << (2 * level), count = 1 << (2 * level);
  vec4 result = vec4(3e38, -3e38, 0.0, 0.0);
  for (int i = 0; i < count && first + i < cells; ++i) {
    vec3 ends = texelFetch(curveCells, ivec2(first + i, row), 0).rgb;
    float place = (2.0 * float(i) + 1.0) / float(count) - 1.0;
    result = vec4(min(result.x, ends.x), max(result.y, ends.y), result.z + ends.z / float(count), result.w + ends.z * place / float(count));
  }
  outNode = result;
}
