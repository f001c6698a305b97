#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Debug view of samples: adds up the colours of the samples in each pixel. Writes debugView: image size, RGBA32F.
flat in vec3 colour;
layout(location = 0) out vec4 outColour;

void main() { outColour = vec4(colour, 1.0); }
