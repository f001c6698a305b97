#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Tint sums: one step of the prefix sums over tintGroups.frag's groups, in log passes. FOLD: the sum of four, one level
uniform sampler2D tintRed;
uniform sampler2D tintGreen;
uniform sampler2D tintBlue;
#ifdef COARSER
uniform sampler2D coarserRed;
uniform sampler2D coarserGreen;
uniform sampler2D coarserBlue;
#endif

layout(location = 0) out vec4 outRed;
layout(location = 1) out vec4 outGreen;
layout(location = 2) out vec4 outBlue;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  outRed = outGreen = outBlue = vec4(0.0);
#ifdef FOLD
  int first = 4 * at.x, last = first + 3;
#else
  int first = 0, last = at.x;
#endif
#ifdef COARSER
  first = at.x & ~3;
  if (first > 0) {
    ivec2 before = ivec2((at.x >> 2) - 1, at.y);
    outRed = texelFetch(coarserRed, before, 0);
    outGreen = texelFetch(coarserGreen, before, 0);
    outBlue = texelFetch(coarserBlue, before, 0);
  }
#endif
  for (int i = first; i <= last; ++i) {
    outRed += texelFetch(tintRed, ivec2(i, at.y), 0);
    outGreen += texelFetch(tintGreen, ivec2(i, at.y), 0);
    outBlue += texelFetch(tintBlue, ivec2(i, at.y), 0);
  }
}
