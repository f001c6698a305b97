// Debug view of samples: a triangle around the centre of the pixel that holds a sample, in the sample's colour, for every sample
// that the view shows (shownSamples). Draws 3 vertices a sample,
// slice by slice. Reads the slice table, sliceBlocks, sampleEnds, marks and refinedMarks.
#include "shared.glsl"
#include "lib/slices.glsl"
#include "lib/bits.glsl"
#include "lib/breaks.glsl"

uniform sampler2D sampleEnds;
uniform sampler2D marks;
uniform sampler2D refinedMarks;
flat out vec3 colour;

bool isMarked(sampler2D masks, int slice, int index) {
  return ((masksOf(texelFetch(masks, ivec2(slice, index >> 6), 0))[(index >> 4) & 3] >> (index & 15)) & 1) != 0;
}

// The ray's end at a sample; negative where the slice has none.
float endAt(int slice, int index) {
  return index >= 0 && index < samplesPerSlice ? texelFetch(sampleEnds, ivec2(slice, index), 0).r : -1.0;
}

bool isBreakAfter(int slice, int index) {
  float low = endAt(slice, index), high = endAt(slice, index + 1);
  return low >= 0.0 && high >= 0.0 && isBreak(endAt(slice, index - 1), low, high, endAt(slice, index + 2));
}

vec3 breakColour(int slice, int index) {
  float before = endAt(slice, index - 1), end = endAt(slice, index), after = endAt(slice, index + 1);
  bool breakBefore = isBreakAfter(slice, index - 1), breakAfter = isBreakAfter(slice, index);
  if ((breakBefore && end < before) || (breakAfter && end < after)) return vec3(1.0, 0.0, 0.0);
  return breakBefore || breakAfter ? vec3(0.0, 0.0, 1.0) : vec3(0.0);
}

vec3 marchColour(int slice, int index) {
  if ((index & 15) == 0) return vec3(0.0, 0.0, 1.0);
  if (isMarked(marks, slice, index)) return vec3(1.0, 0.0, 0.0);
  return isMarked(refinedMarks, slice, index) ? vec3(0.0, 1.0, 0.0) : vec3(0.0);
}

// Black: not shown.
vec3 colourOf(int slice, int index) {
  if (index >= sliceSamples(slice) || slice >= drawnColumns()) return vec3(0.0);
  if (shownSamples == 0) return vec3(1.0, 1.0 / 4.0, 1.0 / 16.0);
  return shownSamples == 1 ? breakColour(slice, index) : marchColour(slice, index);
}

void main() {
  int id = gl_VertexID / 3, corner = gl_VertexID % 3, slice = id / samplesPerSlice, index = id % samplesPerSlice;
  colour = colourOf(slice, index);
  vec2 centre = floor(samplePosition(sliceEnds(slice), sliceSamples(slice), float(index)) + jitter) + 0.5;
  vec2 p = centre + vec2(corner == 0 ? -0.4 : corner == 1 ? 0.4 : 0.0, corner == 2 ? 0.4 : -0.4);
  gl_Position = colour == vec3(0.0) ? vec4(2.0, 2.0, 0.0, 1.0) : vec4(2.0 * p / vec2(frameSize) - 1.0, 0.0, 1.0);
}
