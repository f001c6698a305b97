// Debug view of difference: inscatter less that of exact, mean over R, G, B, as a part of the mean of exact over the image; full
// colour at 10 %, and a scale bar from -10 % to 10 % with a tick every 5 %.
// Reads inscatter and exactInscatter (image size, RGB) and meanInscatter (1 x 1). Writes the back buffer.
#include "shared.glsl"
#include "lib/scale.glsl"

uniform sampler2D inscatter;
uniform sampler2D exactInscatter;
uniform sampler2D meanInscatter;
layout(location = 0) out vec4 outColour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 off = texelFetch(inscatter, pixel, 0).rgb - texelFetch(exactInscatter, pixel, 0).rgb;
  float scale = 0.1 * texelFetch(meanInscatter, ivec2(0), 0).r;
  float t = (off.r + off.g + off.b) / 3.0 / max(scale, 1e-30); // a black image has no mean
  float bar = barPosition(gl_FragCoord.xy, vec2(frameSize), 4);
  outColour = vec4(bar == kTick ? vec3(0.0) : signedColour(bar == kOffBar ? t : 2.0 * bar - 1.0), 1.0);
}
