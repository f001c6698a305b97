// Drawn segments: which segments of which columns of slices there are, as changedSegments.frag says it, for a sliceTarget; others are not
// written. Reads the slice table and sliceBlocks. Writes changedSegments.
#include "shared.glsl"
#include "lib/slices.glsl"

layout(location = 0) out vec4 outChanged;

void main() {
  int column = int(gl_FragCoord.x);
  if (column >= drawnColumns() || 16 * int(gl_FragCoord.y) >= sliceSamples(column)) discard;
  outChanged = vec4(1.0, 0.0, 0.0, 1.0);
}
