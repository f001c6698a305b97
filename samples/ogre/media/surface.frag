#version 330 core
uniform sampler2DShadow shadow0, shadow1, shadow2, shadow3;
uniform vec4 albedo, splits; // splits: where cascades end
uniform vec4 sunDirection, sunColour;
uniform vec4 spotPosition, spotDirection, spotColour, spotCone; // cone: cosines of the inner and outer half angles
in vec3 world, worldNormal;
in vec4 places[4];
in float depth;
out vec4 colour;

float lit(sampler2DShadow map, vec4 place) {
  vec3 at = place.xyz / place.w;
  return texture(map, vec3(at.xy, at.z * 0.5 + 0.5 - 0.002));
}

void main() {
  vec3 normal = normalize(worldNormal);
  float sun = depth < splits.x ? lit(shadow0, places[0]) : depth < splits.y ? lit(shadow1, places[1]) : lit(shadow2, places[2]);
  vec3 light = sun * max(-dot(normal, sunDirection.xyz), 0) * sunColour.rgb;

  vec3 toSpot = spotPosition.xyz - world;
  float distance2 = dot(toSpot, toSpot), cosine = -dot(toSpot, spotDirection.xyz) * inversesqrt(distance2);
  float cone = clamp((cosine - spotCone.y) / (spotCone.x - spotCone.y), 0, 1);
  if (cone > 0) {
    light += lit(shadow3, places[3]) * cone * cone * max(dot(normal, toSpot), 0) * inversesqrt(distance2) / distance2 * spotColour.rgb;
  }
  colour = vec4(albedo.rgb * (light / 3.14159 + 0.03), 1);
}
