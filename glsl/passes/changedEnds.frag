// Changed ends: the segments of which a sample's end is not what it was in the last frame. Reads sampleEnds of both
// frames. Writes slices x segments, R32F: 1 or 0.
#include "shared.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D lastSampleEnds;
layout(location = 0) out vec4 outChanged;

void main() {
  int slice = int(gl_FragCoord.x), first = 16 * int(gl_FragCoord.y);
  bool changed = false;
  for (int i = first; i < first + 16; ++i)
    changed = changed || floatBitsToInt(texelFetch(sampleEnds, ivec2(slice, i), 0).r) != floatBitsToInt(texelFetch(lastSampleEnds, ivec2(slice, i), 0).r);
  outChanged = vec4(changed ? 1.0 : 0.0);
}
