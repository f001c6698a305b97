// Map copy: what one view of a light shows of the engine's shadow map, a layer of our own, for all passes that read maps: cubes,
// depths that are distances, and several views of one texture where that is seldom (plan/MapCopies.cpp).
// Reads the shadow map (glass map): SOURCE 0 a texture, 1 an array, 2 a cube map, 3 an array of those. Writes shadowCopy, R32F: window
// depth of the view, the far plane's where there is no caster; with GLASS its tint and depth, too.
#if SOURCE == 3 && !defined(GL_ES)
#extension GL_ARB_texture_cube_map_array : require
#endif
#include "shared.glsl"

#if SOURCE == 0
uniform sampler2D shadowMap;
uniform sampler2D glassColour;
uniform sampler2D glassDepth;
#elif SOURCE == 1
uniform sampler2DArray shadowMap;
uniform sampler2DArray glassColour;
uniform sampler2DArray glassDepth;
#elif SOURCE == 2
uniform samplerCube shadowMap;
uniform samplerCube glassColour;
uniform samplerCube glassDepth;
#else
uniform samplerCubeArray shadowMap;
uniform samplerCubeArray glassColour;
uniform samplerCubeArray glassDepth;
#endif
layout(location = 0) out vec4 outDepth;
#if GLASS
layout(location = 1) out vec4 outTint;
layout(location = 2) out vec4 outPane;
#endif

#if SOURCE < 2
#if SOURCE == 0
#define TEXEL(map, texel) texelFetch(map, copiedOrigin + texel, 0)
#else
#define TEXEL(map, texel) texelFetch(map, ivec3(copiedOrigin + texel, copiedLayer), 0)
#endif
#else

// To the centre of a cube face's texel (OpenGL 4.6, table 8.19): from there nearest filtering takes that texel.
vec3 cubeDirection(ivec2 texel, int face) {
  vec2 p = (2.0 * vec2(texel) + 1.0) / vec2(copiedSize) - 1.0;
  float side = (face & 1) == 0 ? 1.0 : -1.0;
  return face < 2 ? vec3(side, -p.y, -side * p.x) : face < 4 ? vec3(p.x, side, side * p.y) : vec3(side * p.x, -p.y, side);
}

#if SOURCE == 2
#define TEXEL(map, texel) textureLod(map, cubeDirection(texel, copiedLayer), 0.0)
#else
#define TEXEL(map, texel) textureLod(map, vec4(cubeDirection(texel, copiedLayer % 6), float(copiedLayer / 6)), 0.0)
#endif
#endif

// Stored depth as window depth.
float windowDepth(float stored, ivec2 texel) {
  if (copiedEncoding == 0) return stored;
  vec2 place = (2.0 * vec2(texel) + 1.0) / vec2(copiedSize) - 1.0;
  vec3 ray = copiedRay[0].xyz + place.x * copiedRay[1].xyz + place.y * copiedRay[2].xyz;
  float d = copiedOffset + copiedUnit * stored, along = copiedEncoding == 2 ? d / length(ray) : d;
  bool isEmpty = !(abs(d) < 3e38) || along >= copiedFar - copiedRounding || abs(d - copiedFar) <= copiedRounding;
  // What is nearer than the near plane is at that plane.
  float term = copiedIsOrthographic != 0 ? copiedDepth.w * along : copiedDepth.w / max(along, 1e-30);
  return isEmpty ? copiedFarDepth : clamp(copiedDepth.x + dot(copiedDepth.yz, place) + term, 0.0, 1.0);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  outDepth = vec4(windowDepth(TEXEL(shadowMap, texel).r, texel));
#if GLASS
  outTint = TEXEL(glassColour, texel);
  outPane = vec4(windowDepth(TEXEL(glassDepth, texel).r, texel));
#endif
}
