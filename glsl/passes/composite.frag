// Composite: blends finished inscatter and transmittance (both image size, RGB) into the back buffer,
// out = back * transmittance + inscatter; inscatter to no more than the format holds. By dual-source blending or, COPIED, in
// the shader, from a copy of what is there: then RGB is written over.
#include "shared.glsl"
uniform sampler2D inscatter;
uniform sampler2D transmittance;

#ifdef COPIED
uniform sampler2D colourCopy;
layout(location = 0) out vec4 outColour;
#else
#include "lib/outputs.glsl"
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 light = min(texelFetch(inscatter, pixel, 0).rgb, vec3(colourMax)), share = texelFetch(transmittance, pixel, 0).rgb;
#ifdef COPIED
  outColour = vec4(texelFetch(colourCopy, pixel, 0).rgb * share + light, 1.0);
#else
  outInscatter = vec4(light, 0.0);
  outTransmittance = vec4(share, 1.0);
#endif
}
