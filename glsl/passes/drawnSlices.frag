// Drawn slices: the slice table of those that are drawn for a sliceTarget, one a column. Reads candidateTable, the table of all, and sliceBlocks.
// Writes the slice table.
#include "shared.glsl"
#include "lib/slices.glsl"

uniform sampler2D candidateTable;
layout(location = 0) out vec4 outTexel;

// The last block whose first column is not behind one.
int blockOf(int column) {
  int low = 0, high = candidateSlices / SLICE_BLOCK - 1;
  for (int i = 0; i < 16 && low < high; ++i) {
    int middle = (low + high + 1) / 2;
    if (int(texelFetch(sliceBlocks, ivec2(middle, 0), 0).r) <= column) low = middle;
    else high = middle - 1;
  }
  return low;
}

void main() {
  int column = min(int(gl_FragCoord.x), drawnColumns() - 1), block = blockOf(column); // strips of eight columns end behind the last
  ivec2 own = ivec2(texelFetch(sliceBlocks, ivec2(block, 0), 0).rg);
  int slice = SLICE_BLOCK * block + (column - own.x) * (SLICE_BLOCK / own.y);
  outTexel = texelFetch(candidateTable, ivec2(slice, int(gl_FragCoord.y)), 0);
}
