// Debug view of visits: node visits as a heat map, log2(1 + visits) over 10, and its scale bar: a tick at each factor of 4.
// Reads image (image size; visits in R). Writes the back buffer.
#include "shared.glsl"
#include "lib/scale.glsl"

uniform sampler2D image;
layout(location = 0) out vec4 outColour;

void main() {
  float t = log2(1.0 + texelFetch(image, ivec2(gl_FragCoord.xy), 0).r) / 10.0;
  float bar = barPosition(gl_FragCoord.xy, vec2(frameSize), 5);
  outColour = vec4(bar == kTick ? vec3(0.5) : heat(bar == kOffBar ? t : bar), 1.0);
}
