#version 330 core
uniform mat4 clipFromObject, worldFromObject, viewFromObject;
uniform mat4 shadowFromWorld0, shadowFromWorld1, shadowFromWorld2, shadowFromWorld3;
in vec4 vertex;
in vec3 normal;
out vec3 world, worldNormal;
out vec4 places[4]; // in the shadow maps: three cascades of the sun, the spot
out float depth;    // before the eye, which chooses the cascade

void main() {
  vec4 point = worldFromObject * vertex;
  world = point.xyz;
  worldNormal = inverse(transpose(mat3(worldFromObject))) * normal;
  places[0] = shadowFromWorld0 * point;
  places[1] = shadowFromWorld1 * point;
  places[2] = shadowFromWorld2 * point;
  places[3] = shadowFromWorld3 * point;
  depth = -(viewFromObject * vertex).z;
  gl_Position = clipFromObject * vertex;
}
