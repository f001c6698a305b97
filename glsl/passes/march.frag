// March: inscatter of one light, through one shadow view, at march samples: along the slice's row and its tree.
// EXTRA 0: the first sample of each segment, target slices x segments. EXTRA 1: the marked samples between, in order,
// packed into chunks of 64 rows, target slices x samples. Reads slice table, sampleEnds, marks, row textures.
// Writes inscatter without the light's colour, R32F (monochrome) or RGBA16F with it; added up over the views.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/phase.glsl"
#include "lib/airlight.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"
#include "lib/shadow.glsl"
#include "lib/tree.glsl"
#include "lib/row.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D marks;
layout(location = 0) out vec4 outInscatter;

int sampleIndex(int slice, int y) {
#if EXTRA
  vec4 masks = texelFetch(marks, ivec2(slice, y >> 6), 0);
  int rank = y & 63, index = -1;
  for (int s = 0; s < 4; ++s) {
    int mask = int(masks[s]) & ~1, count = popcount(mask);
    if (index < 0 && rank < count) {
      for (int k = 0; k < rank; ++k)
        mask &= mask - 1;
      index = (y & ~63) + 16 * s + lowestBit(mask);
    }
    rank -= count;
  }
  return index;
#else
  return 16 * y;
#endif
}

void main() {
  int slice = int(gl_FragCoord.x), samples = sliceSamples(slice);
  int index = sampleIndex(slice, int(gl_FragCoord.y));
  float end = index >= 0 && index < samples ? texelFetch(sampleEnds, ivec2(slice, index), 0).r : 0.0;
  Ray ray = cameraRay(samplePosition(sliceEnds(slice), samples, max(index, 0)));
  outInscatter = vec4(storedLight(rowShadowedLight(ray, max(end, 0.0), slice)), 0.0);
}
