// Slice budget: how many slices are drawn at prices that are higher and higher (lib/sliceSpacing.glsl), and how much error is left. Reads
// sliceSpacing. Writes SLICE_BUDGETS x 1, RGBA32F: slices, the mean of the error's square, the price.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/sliceSpacing.glsl"

layout(location = 0) out vec4 outBudget;

void main() {
  int blocks = candidateSlices / SLICE_BLOCK, slices = 0;
  float area = 0.0, error = 0.0, dearest = 0.0;
  for (int block = 0; block < blocks; ++block) {
    vec4 own = spacingOf(block);
    area += own.z;
    dearest = max(dearest, gainOf(own, own.x, 1));
  }
  // By fourth roots of 2, up to what nothing is worth.
  float price = dearest * exp2(0.25 * float(int(gl_FragCoord.x) - (SLICE_BUDGETS - 1)));
  for (int block = 0; block < blocks; ++block) {
    vec4 own = spacingOf(block);
    int drawn = slicesFor(own, price);
    slices += drawn;
    error += own.z * errorWith(own, drawn);
  }
  outBudget = vec4(float(slices), error / max(area, 1e-30), price, 0.0);
}
