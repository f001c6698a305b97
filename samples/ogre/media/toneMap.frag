#version 330 core
uniform sampler2D hdr;
in vec2 place;
out vec4 colour;
void main() { colour = vec4(pow(1 - exp(-texture(hdr, place).rgb), vec3(1 / 2.2)), 1); }
