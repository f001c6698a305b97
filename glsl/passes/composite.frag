// Composite: blends finished inscatter and transmittance (both image size, RGB) into the back buffer,
// out = back * transmittance + inscatter, by dual-source blending; inscatter to no more than the format holds.
#include "shared.glsl"
uniform sampler2D inscatter;
uniform sampler2D transmittance;

layout(location = 0, index = 0) out vec4 outInscatter;
layout(location = 0, index = 1) out vec4 outTransmittance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  outInscatter = vec4(min(texelFetch(inscatter, pixel, 0).rgb, vec3(colourMax)), 0.0);
  outTransmittance = vec4(texelFetch(transmittance, pixel, 0).rgb, 1.0);
}
