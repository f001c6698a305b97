// Copy image: a kept picture (image size) into a texture of the engine's. Reads and writes texel by texel.
uniform sampler2D inscatter;

layout(location = 0) out vec4 outColour;

void main() { outColour = texelFetch(inscatter, ivec2(gl_FragCoord.xy), 0); }
