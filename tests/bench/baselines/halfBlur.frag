// Blur along one axis, seven taps, each weighted by how well its distance agrees: takes the noise of the steps away and
// keeps edges. Reads half-resolution inscatter and distance. Writes inscatter (RGBA16F).
#include "shared.glsl"
#include "common/agreement.glsl"

uniform sampler2D halfInscatter;
uniform sampler2D halfEnd;
uniform vec2 axis;
layout(location = 0) out vec4 outInscatter;

void main() {
  ivec2 centre = ivec2(gl_FragCoord.xy), last = textureSize(halfEnd, 0) - 1;
  float end = comparableEnd(texelFetch(halfEnd, centre, 0).r);
  vec4 sum = vec4(0.0);
  for (int i = -3; i <= 3; ++i) {
    ivec2 at = clamp(centre + i * ivec2(axis), ivec2(0), last);
    float weight = exp(-0.5 * float(i * i) / 2.25) * agreementOf(comparableEnd(texelFetch(halfEnd, at, 0).r), end);
    sum += weight * vec4(texelFetch(halfInscatter, at, 0).rgb, 1.0);
  }
  outInscatter = vec4(sum.rgb / sum.w, 1.0);
}
