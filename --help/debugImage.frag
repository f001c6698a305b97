#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Debug view of image: shows a texture of the image's size as it is. Reads image (RGB). Writes the back buffer.
uniform sampler2D image;
layout(location = 0) out vec4 outColour;

void main() { outColour = texelFetch(image, ivec2(gl_FragCoord.xy), 0); }
