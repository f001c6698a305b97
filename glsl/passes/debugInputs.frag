// Debug view of inputs: depth as distance, a line each time it doubles; a hue for the shadow view that a surface lies in, grey outside
// of all; darker where the map shadows it, magenta where it lies far in front of the map's surface, orange where the map has none.
// Reads the scene depth and the first light's shadow map. Writes the back buffer.
#include "shared.glsl"
#include "lib/camera.glsl"
#include "lib/depthSamples.glsl"
#include "lib/shadowMap.glsl"
#include "lib/inputs.glsl"

layout(location = 0) out vec4 outColour;

float doublings(ivec2 pixel) { return log2(max(seenIn(min(pixel, frameSize - 1)), 1e-30)); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int view, hints, found = surfaceInMap(pixel, view, hints) & 7;
  float end = seenIn(pixel), here = floor(doublings(pixel));
  bool onLine = here != floor(doublings(pixel + ivec2(1, 0))) || here != floor(doublings(pixel + ivec2(0, 1)));
  int step = 3 * (view % 2) + view / 2; // neighbours far apart, from yellow to blue: the rest is that of mistakes
  vec3 hue = clamp(abs(fract(float(step) * 0.095 + 0.17 + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  vec3 colour = view < 0 ? vec3(0.5) : 0.25 + 0.75 * hue;
  if (found == kHidden) colour *= 0.35;
  if (found == kMissing) colour = vec3(1.0, 0.0, 1.0);
  if (found == kEmpty) colour = vec3(1.0, 0.45, 0.0);
  colour *= 1.0 - 0.5 * fract(doublings(pixel));
  if (onLine) colour = vec3(1.0);
  if (!(end > 0.0)) colour = vec3(1.0, 0.0, 0.0); // no number
  if (end >= 3e38) colour = vec3(0.05, 0.08, 0.15);
  outColour = vec4(colour, 1.0);
}
