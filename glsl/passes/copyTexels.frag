// Copy texels: a texture of slices or rows, a depth or a kept picture into another texture of the same size. CAPPED:
// radiance, to no more than the target's format holds.
#include "shared.glsl"
uniform sampler2D image;
layout(location = 0) out vec4 outTexel;

void main() {
  outTexel = texelFetch(image, ivec2(gl_FragCoord.xy), 0);
#ifdef CAPPED
  outTexel = min(outTexel, vec4(outputMax));
#endif
}
