#version 330 core
#define UNIFORM_BLOCK(name) layout(std140) uniform name
// Every sample from its two sources, linearly. Reads sources and marched. Writes lines x samples, RGBA16F.
uniform sampler2D sources;
uniform sampler2D marched;
layout(location = 0) out vec4 outInscatter;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 source = texelFetch(sources, at, 0).rg;
  float span = source.y - source.x;
  vec4 low = texelFetch(marched, ivec2(at.x, int(source.x)), 0), high = texelFetch(marched, ivec2(at.x, int(source.y)), 0);
  outInscatter = mix(low, high, span > 0.0 ? (float(at.y) - source.x) / span : 0.0);
}
