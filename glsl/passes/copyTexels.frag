// Copy texels: a texture of slices or rows into the one that is kept. Reads and writes texel by texel.
uniform sampler2D image;
layout(location = 0) out vec4 outTexel;

void main() { outTexel = texelFetch(image, ivec2(gl_FragCoord.xy), 0); }
