// Slice budget: how many slices prices take that are less and less strict (lib/sliceSpacing.glsl), and how much error they leave. Reads
// sliceSpacing. Writes SLICE_BUDGETS x 1, RGBA32F: slices, the mean of the error's square, the price.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

layout(location = 0) out vec4 outBudget;

// Roots of powers of 2, around what a block would gain by its last slices that then meets the target. The last one nothing is worth.
float priceOf(int step, float area) {
  return step == SLICE_BUDGETS - 1 ? 2e30 : sliceTarget * sliceTarget * area * exp2(0.25 * float(step) - 8.0);
}

void main() {
  int blocks = candidateSlices / SLICE_BLOCK, slices = 0;
  float area = 0.0, error = 0.0;
  for (int block = 0; block < blocks; ++block) area += spacingOf(block).z;
  float price = priceOf(int(gl_FragCoord.x), area / float(blocks));
  for (int block = 0; block < blocks; ++block) {
    vec4 own = spacingOf(block);
    int drawn = slicesFor(own, price);
    slices += drawn;
    error += own.z * errorWith(own, drawn);
  }
  outBudget = vec4(float(slices), error / max(area, 1e-30), price, 0.0);
}
