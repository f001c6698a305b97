// The shadow volume's surface (Billeter et al. 2010): a grid over the shadow map, each vertex at the depth of its texel;
// the outer ring drops to the bottom behind all that is seen, so that the walls close. CAP 1: the bottom itself.
#include "shared.glsl"
#include "lib/shadowMap.glsl"

uniform int cells;             // grid vertices a side, without the ring
uniform mat4 cameraFromTexel;  // of the shadow view
uniform mat4 clipFromCamera;
out vec3 cameraPosition;

void main() {
  vec2 size = vec2(shadowViews[0].size);
  float bottom = shadowViews[0].farDepth + 1.0; // one depth range behind the far plane
#if CAP
  const ivec2 kCorners[6] = ivec2[6](ivec2(0, 0), ivec2(0, 1), ivec2(1, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1));
  vec3 texel = vec3(vec2(kCorners[gl_VertexID]) * size, bottom);
#else
  int stride = cells + 2;
  ivec2 vertex = ivec2(gl_VertexID % stride, gl_VertexID / stride) - 1;
  bool ring = any(lessThan(vertex, ivec2(0))) || any(greaterThanEqual(vertex, ivec2(cells)));
  ivec2 cell = clamp(vertex, ivec2(0), ivec2(cells - 1));
  vec2 at = (vec2(cell) + 0.5) / float(cells) * size;
  // The outermost vertices stand on the map's border, right above the ring.
  at = mix(at, vec2(0.0), equal(cell, ivec2(0)));
  at = mix(at, size, equal(cell, ivec2(cells - 1)));
  float depth = casterDepth(min(ivec2((vec2(cell) + 0.5) / float(cells) * size), shadowViews[0].size - 1), 0);
  vec3 texel = vec3(at, ring ? bottom : min(depth, bottom));
#endif
  vec4 position = cameraFromTexel * vec4(texel, 1.0);
  cameraPosition = position.xyz / position.w;
  gl_Position = clipFromCamera * vec4(cameraPosition, 1.0);
}
