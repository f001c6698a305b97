// Changed slices: those of which a sample's end or a texel of a row is not what it was in the last frame. Two steps:
// parts of slices, then (FOLD) slices, where what has not changed is discarded, so that the others can be counted.
// Reads sampleEnds (ENDS 1) and what rows hold (ROWS 1), each with the last frame's, or the parts. Writes slices x 32, or slices x 1: 1.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/rows.glsl"

const int kParts = 32;
layout(location = 0) out vec4 outChanged;

#ifdef FOLD

uniform sampler2D changedParts;

void main() {
  int slice = int(gl_FragCoord.x);
  bool changed = slice >= refresh.x && slice < refresh.y;
  for (int i = 0; i < kParts; ++i) changed = changed || texelFetch(changedParts, ivec2(slice, i), 0).r > 0.0;
  if (!changed) discard;
  outChanged = vec4(1.0);
}

#else

#if ENDS
uniform sampler2D sampleEnds;
uniform sampler2D lastSampleEnds;
#endif
#if ROWS
uniform sampler2D rowStates; // rowDepths, or rowHashes where those do not hold all that decides
uniform sampler2D lastRowStates;
#endif

bool differs(sampler2D now, sampler2D last, ivec2 at) {
  return any(notEqual(floatBitsToInt(texelFetch(now, at, 0)), floatBitsToInt(texelFetch(last, at, 0))));
}

void main() {
  int slice = int(gl_FragCoord.x), part = int(gl_FragCoord.y);
  bool changed = false;
#if ENDS
  for (int i = part; i < sliceSamples(slice) && !changed; i += kParts) changed = differs(sampleEnds, lastSampleEnds, ivec2(slice, i));
#endif
#if ROWS
  for (int view = 0; view < march.y; ++view)
    for (int i = part; i < rowTexels(view, slice) / 4 && !changed; i += kParts)
      changed = differs(rowStates, lastRowStates, ivec2(i, rowOf(view, slice)));
#endif
  outChanged = vec4(changed ? 1.0 : 0.0);
}

#endif
