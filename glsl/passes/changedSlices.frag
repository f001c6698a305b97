// Changed slices: from which to before which segment any of eight slices has changed, by whole chunks, and whether their rows
// have: what changedStrips.vert and strips.vert draw; and whether the slice's own row has. Reads changedSegments and changedParts
// (comparesRows). Writes slices x 1: first segment, one past the last (0, 0: none), 1 for rows, 1 for the own row.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"

uniform sampler2D changedSegments;
uniform sampler2D changedParts;
layout(location = 0) out vec4 outRange;

bool hasRowChanged(int slice) {
  bool changed = false;
  for (int view = 0; comparesRows != 0 && view < drawnViews; ++view)
    for (int part = 0; part < (rowTexels(view, slice) + 255) / 256; ++part) {
      vec2 bounds = texelFetch(changedParts, ivec2(part, rowOf(view, slice)), 0).rg;
      changed = changed || bounds.x <= bounds.y;
    }
  return changed;
}

void main() {
  int group = int(gl_FragCoord.x) & ~7, first = samplesPerSlice, last = 0;
  bool rows = false, own = hasRowChanged(int(gl_FragCoord.x));
  for (int slice = group; slice < min(group + 8, sliceCount); ++slice) {
    rows = rows || hasRowChanged(slice);
    for (int i = 0; i < samplesPerSlice / 16; ++i)
      if (texelFetch(changedSegments, ivec2(slice, i), 0).r > 0.0) {
        first = min(first, i);
        last = max(last, i + 1);
      }
  }
  vec2 range = last > 0 ? vec2(float(first & ~3), float((last + 3) & ~3)) : vec2(0.0);
  outRange = vec4(range, rows ? 1.0 : 0.0, own ? 1.0 : 0.0);
}
