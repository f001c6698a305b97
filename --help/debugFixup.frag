#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Debug view of the fix-up: red, where the stencil lets it. Writes debugView: image size, RGBA32F.
layout(location = 0) out vec4 outColour;

void main() { outColour = vec4(1.0, 0.0, 0.0, 1.0); }
