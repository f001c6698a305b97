#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// A coarser level from the one below it, which is the texture's base level for now. Writes RG32F.
uniform sampler2D pyramid;
layout(location = 0) out vec2 outBounds;

void main() {
  ivec2 low = 2 * ivec2(gl_FragCoord.xy), high = min(low + 1, textureSize(pyramid, 0) - 1);
  vec2 a = texelFetch(pyramid, low, 0).rg, b = texelFetch(pyramid, ivec2(high.x, low.y), 0).rg;
  vec2 c = texelFetch(pyramid, ivec2(low.x, high.y), 0).rg, d = texelFetch(pyramid, high, 0).rg;
  outBounds = vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}
