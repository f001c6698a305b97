// Slice budget: how many slices targets take that are less and less strict (lib/sliceSpacing.glsl). Reads sliceSpacing. Writes SLICE_BUDGETS x 1,
// R32F.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

layout(location = 0) out vec4 outSlices;

void main() {
  int slices = 0;
  for (int block = 0; block < candidateSlices / SLICE_BLOCK; ++block) slices += slicesFor(spacingOf(block), budgetTarget(int(gl_FragCoord.x)));
  outSlices = vec4(float(slices), 0.0, 0.0, 0.0);
}
