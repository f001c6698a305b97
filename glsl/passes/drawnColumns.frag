// Drawn columns: which columns of slices there are, as changedSlices.frag says it, for a sliceTarget; others are not written. Reads sliceBlocks.
#include "shared.glsl"
#include "lib/slices.glsl"

layout(location = 0) out vec4 outRange;

void main() {
  if ((int(gl_FragCoord.x) & ~7) >= drawnColumns()) discard; // in strips of eight
  outRange = vec4(0.0, float(samplesPerSlice / 16), 1.0, 1.0);
}
