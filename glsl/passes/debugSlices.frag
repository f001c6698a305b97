// Debug view of slices: each pixel's nearest slice, a hue for sixteen of them, every second one darker; the epipole white. With a
// sliceTarget the hue is for how far apart the slices are that are drawn. Reads the slice table and sliceBlocks.
// Writes debugView: image size, RGBA32F.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/slices.glsl"

layout(location = 0) out vec4 outColour;

void main() {
  vec2 p = unjittered(gl_FragCoord.xy);
  SlicePair pair = slicesAround(sliceCoordinate(p));
  int slice = pair.share < 0.5 ? pair.columns.x : pair.columns.y;
  float hue = fract(float(slice >> 4) * 0.618034); // the golden ratio: neighbours differ
  if (sliceTarget > 0.0) hue = pair.apart < 8 ? log2(float(pair.apart)) / 6.0 : 2.0 / 3.0; // red, yellow, green, blue
  vec3 colour = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  colour = (0.2 + 0.8 * colour) * ((slice & 1) == 0 ? 1.0 : 0.6);
  if (distance(p * epipole.z, epipole.xy) < 2.0 * abs(epipole.z)) colour = vec3(1.0);
  outColour = vec4(colour, 1.0);
}
