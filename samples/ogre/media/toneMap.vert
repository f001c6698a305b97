#version 330 core
uniform mat4 clipFromQuad;
in vec4 vertex;
in vec2 uv0;
out vec2 place;
void main() {
  place = uv0;
  gl_Position = clipFromQuad * vertex;
}
