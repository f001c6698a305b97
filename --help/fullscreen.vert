#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// One triangle that covers the viewport; draws without vertex attributes.
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID & 2) * 2 - 1);
  gl_Position = vec4(corner, 0.0, 1.0);
}
