#version 330 core
uniform mat4 clipFromObject;
in vec4 vertex;
void main() { gl_Position = clipFromObject * vertex; }
